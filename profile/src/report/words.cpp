// The words that every format shares.
#include <algorithm>
#include <cctype>
#include <cmath>

#include <fmt/format.h>

#include <itin/crs_words.hpp>
#include <itin/grazing.hpp>
#include <itin/precondition.hpp>
#include <profile/report_text.hpp>

namespace itin::profile {

namespace {

const char* meaning_of(NoData rule) {
  constexpr const char* kMeanings[] = {"leaves it undecided", "counts as blocking", "counts as clear"};
  return kMeanings[static_cast<int>(rule)];
}

std::string amount(double metres) {
  return std::abs(metres) < 0.005 ? "less than 0.01 m" : fmt::format("{:.2f} m", std::abs(metres));
}

}  // namespace

DistanceUnit unit_of(const LosReport& report) {
  constexpr double kLongLine = 2000;
  return report.profile.length_m < kLongLine ? DistanceUnit::kMetres : DistanceUnit::kKilometres;
}

std::string distance_text(double metres, DistanceUnit unit) {
  return unit == DistanceUnit::kMetres ? fmt::format("{:.1f} m", metres) : fmt::format("{:.3f} km", metres / 1000);
}

std::string gap_text(const LosReport& report, DistanceUnit unit) {
  const double gap = report.profile.has_length() ? report.profile.gap_length_m() : 0;
  if (gap == 0) return {};
  const std::string none = fmt::format("no data over {} of the line", distance_text(gap, unit));
  if (report.known_verdict == SightVerdict::kHidden) return none + "; known ground hides it";
  return fmt::format("{}, which {}; {}", none, meaning_of(report.query.nodata),
                     report.known_verdict == SightVerdict::kVisible
                         ? "known ground does not hide it"
                         : "the surface's certified error leaves open whether known ground hides it");
}

std::string fade_note(const LineFindings& found, double length_m) {
  const bool asked = std::any_of(found.criteria.begin(), found.criteria.end(),
                                 [](const CriterionResult& c) { return c.criterion.fade; });
  if (!asked) return "";
  return std::string("ke is 157 / (144 + 2670 / length in km), ") +
         (length_m < kShortestFade ? "and that of 10 km below 10 km, where its curve begins; the formula"
                                   : "a formula that") +
         " has not been confirmed from the text of ITU-R P.530.";
}

std::string reason_of(const LosReport& report, DistanceUnit unit) {
  if (std::string gaps = gap_text(report, unit); !gaps.empty()) return gaps;
  if (report.verdict != SightVerdict::kUndecided) return {};
  return fmt::format("the surface's certified error, {:.2f} m, is greater than the margin; at a tolerance of 0 it is 0",
                     report.query.clearance_error_m);
}

std::string verdict_text(const LosReport& report) {
  std::string text = name_of(report.verdict);
  text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  const std::string why = reason_of(report, unit_of(report));
  return why.empty() ? text : text + ": " + why;
}

std::string outcome_text(const CriterionResult& result, DistanceUnit unit) {
  const char* verdict = name_of(result.verdict);
  if (!result.margin_m) return verdict;
  const bool met = *result.margin_m >= -kGrazing;
  const std::string by = fmt::format("{} at {}", amount(*result.margin_m), distance_text(*result.margin_at_m, unit));
  if (result.verdict == CriterionVerdict::kUndecided)
    return fmt::format("undecided; {} by {} as far as is known", met ? "met" : "missed", by);
  if (result.verdict == CriterionVerdict::kFails && met) return "fails: ground without data counts as blocking";
  return fmt::format("{} by {}", verdict, by);
}

std::string least_fraction_text(const CriterionResult& result, DistanceUnit unit) {
  if (!result.margin_f1) return "";
  return fmt::format("; least clearance {:.2f} F1 at {}", *result.clearance_f1,
                     distance_text(*result.margin_f1_at_m, unit));
}

std::string screen_text(const LosReport& report, DistanceUnit unit) {
  ITIN_PRECONDITION(report.reflection.has_value());
  const Reflection& r = *report.reflection;
  if (!r.ground_m) return "unknown: there is no data at the point";
  if (!r.screen) return report.profile.gaps.empty() ? "clear" : "clear over known ground";
  if (r.screen->distance_m == r.distance_m)
    return fmt::format("screened: {} at the point rises {:.2f} m above the direct path",
                       cause_of(report, r.screen->theme), r.screen_depth_m);
  return fmt::format("screened by {} at {}, {:.2f} m above it", cause_of(report, r.screen->theme),
                     distance_text(r.screen->distance_m, unit), r.screen_depth_m);
}

std::string required_text(const std::optional<double>& height_m) {
  if (!height_m || !std::isfinite(*height_m)) return "no height is enough";
  // A ray that grazes is free, so no centimetre is added for a micrometre.
  return fmt::format("{:.2f} m", std::max(0.0, std::ceil((*height_m - kGrazing) * 100) / 100));
}

}  // namespace itin::profile
