#include "lines/findings.hpp"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include <itin/error.hpp>
#include <itin/grazing.hpp>
#include <profile/radio_text.hpp>

#include "lines/critical_point.hpp"
#include "lines/fresnel_lack.hpp"
#include "lines/line_clearance.hpp"
#include "lines/obstructions.hpp"
#include "lines/sight_verdict.hpp"

namespace itin::profile {

namespace {

double wavelength_of(const LosQuery& query) {
  return query.radio ? wavelength_m(query.radio->frequency_ghz) : 0;
}

double factor_of(const Earth& earth) {
  const double drop = earth.drop_coefficient();
  return drop == 0 ? std::numeric_limits<double>::infinity() : 1 / (2 * drop * earth.radius);
}

/// The factor of the Earth on which a line of this length is judged; a line without length is judged on any.
double factor_of(const Criterion& c, double length_m) {
  return c.fade && length_m > 0 ? fade_factor(length_m) : c.k;
}

/// A ray on one Earth, at its critical point.
struct Clearance {
  std::optional<LineClearance> line;
  std::optional<FresnelClearance> zone;  ///< without a frequency: for a wavelength of 1 m, only if the ray is free
  std::optional<CriticalPoint> critical;

  bool cut() const { return line && line->clearance_m < -kGrazing; }
  bool meets(const Criterion& c) const { return !cut() && (c.fraction == 0 || !zone || zone->fraction >= c.fraction); }
};

/// The clearance with both antennas `shift` metres higher, for lifting the ray is lowering the surface.
Clearance clearance_over(const Sight& sight, const LosQuery& query, const Earth& earth, double shift = 0) {
  const Antennas antennas{sight.antennas.from_m + shift, sight.antennas.to_m + shift};
  Clearance result{line_clearance(sight.profile, antennas, earth), {}, {}};
  if (query.radio || !result.cut())
    result.zone = fresnel_clearance(sight.profile, antennas, earth, query.radio ? wavelength_of(query) : 1);
  if (result.line) result.critical = critical_point(sight.profile, antennas, earth, *result.line, result.zone);
  return result;
}

/// The verdict on a criterion. It is certain if it holds whatever the surface's certified error hides.
CriterionVerdict criterion_verdict(const Sight& sight, const LosQuery& query, const Criterion& criterion,
                                   const Earth& earth) {
  if (!sight.profile.has_length()) return CriterionVerdict::kMeets;
  const double error = query.clearance_error_m;
  if (!clearance_over(sight, query, earth, error).meets(criterion)) return CriterionVerdict::kFails;
  if (!clearance_over(sight, query, earth, -error).meets(criterion)) return CriterionVerdict::kUndecided;
  if (sight.profile.gaps.empty() || query.nodata == NoData::kClear) return CriterionVerdict::kMeets;
  return query.nodata == NoData::kBlock ? CriterionVerdict::kFails : CriterionVerdict::kUndecided;
}

CriterionResult criterion_result(const Sight& sight, const LosQuery& query, const Criterion& criterion) {
  const double k = factor_of(criterion, sight.profile.length_m);
  const Earth earth = with_factor(k, query.earth);
  const Clearance as_is = clearance_over(sight, query, earth);
  CriterionResult result{criterion, k, criterion_verdict(sight, query, criterion, earth), {}, {}, {}, {}, {}, {}};
  if (!as_is.critical) return result;
  result.clearance_m = result.margin_m = as_is.critical->clearance_m;
  result.margin_at_m = as_is.critical->point.distance_m;
  if (!query.radio || !as_is.zone) return result;
  const FresnelClearance& zone = *as_is.zone;
  result.clearance_f1 = zone.fraction;
  if (criterion.fraction == 0) return result;
  const double left = sight.profile.length_m - zone.distance_m;
  result.margin_f1 = zone.fraction - criterion.fraction, result.margin_f1_at_m = zone.distance_m;
  result.margin_m =
      zone.clearance_m - criterion.fraction * fresnel_radius_m(zone.distance_m, left, wavelength_of(query));
  result.margin_at_m = zone.distance_m;
  if (*result.margin_f1 >= 0) return result;
  if (const auto lack = fresnel_lack(sight.profile, sight.antennas, earth, criterion.fraction, wavelength_of(query)))
    result.margin_m = -lack->metres, result.margin_at_m = lack->distance_m;
  return result;
}

std::string criterion_name(const Criterion& c, double k) {
  return fmt::format("K = {}, {:.3g} F1", factor_text(c, k), c.fraction);
}

}  // namespace

void require_valid(const Profile& profile, const LosQuery& query, const Profile& ground) {
  if (!has_ground_at_ends(profile) || (!ground.points.empty() && !has_ground_at_ends(ground))) {
    throw InputError("there is no ground at an end of the line; move it onto the data");
  }
  if (!(query.from_height_m >= 0) || !(query.to_height_m >= 0)) throw InputError("a height above ground is negative");
  for (const Criterion& c : query.criteria) {
    if (c.fraction > 0 && !query.radio) {
      throw InputError("a criterion with a fraction of the Fresnel zone needs a frequency", "radio");
    }
  }
  query.budget.validate();
}

double fade_factor(double length_m) {
  return 157 / (144 + 2670 / (std::max(length_m, kShortestFade) / 1000));
}

Earth with_factor(double k, const Earth& earth) {
  Earth result = Earth::effective_earth(k);
  result.radius = earth.radius;
  return result;
}

std::vector<NamedRequirement> requirements_of(const LosQuery& query, double length_m) {
  const auto with = [&](std::string name, const Earth& earth, double fraction) {
    return NamedRequirement{std::move(name), factor_of(earth), {earth, fraction, wavelength_of(query)}};
  };
  std::vector<NamedRequirement> all = {with("line of sight", query.earth, 0)};
  if (query.radio) all.push_back(with("0.6 F1", query.earth, 0.6));
  for (const Criterion& c : query.criteria) {
    const double k = factor_of(c, length_m);
    all.push_back(with(criterion_name(c, k), with_factor(k, query.earth), c.fraction));
  }
  return all;
}

Antennas antennas_on(const EndGrounds& stands_on, const LosQuery& query) {
  return {stands_on.from_m + query.from_height_m, stands_on.to_m + query.to_height_m};
}

LineFindings findings(const Sight& sight, const LosQuery& query) {
  LineFindings found;
  Clearance clearance = clearance_over(sight, query, query.earth);
  const auto least = clearance.line ? std::optional(clearance.line->clearance_m) : std::nullopt;
  found.known_verdict = known_verdict(sight.profile, least, query.clearance_error_m);
  found.verdict = sight_verdict(sight.profile, found.known_verdict, query.nodata);
  if (clearance.critical) {
    found.critical = clearance.critical->point;
    found.clearance_m = clearance.critical->clearance_m;
    found.lowest = clearance.line->critical;
    found.least_clearance_m = least;
  }
  if (query.radio) found.fresnel = clearance.zone;
  for (const Criterion& c : query.criteria) found.criteria.push_back(criterion_result(sight, query, c));
  return found;
}

void add_obstructions(const Sight& sight, const LosQuery& query, LineFindings& found) {
  if (!found.lowest) return;
  const LineClearance least{*found.least_clearance_m, *found.lowest};
  found.obstructions = obstructions(sight.profile, sight.antennas, query.earth, least);
}

void add_required_heights(const Sight& sight, const LosQuery& query, LineFindings& found) {
  if (!sight.profile.has_length()) return;
  const PlannedHeights planned{query.from_height_m, query.to_height_m};
  std::vector<NamedRequirement> requirements = requirements_of(query, sight.profile.length_m);
  found.required.reserve(requirements.size());
  for (NamedRequirement& one : requirements) {
    const RequiredHeights heights = required_heights(sight.profile, planned, one.requirement, sight.stands_on);
    found.required.push_back({std::move(one.name), one.k, one.requirement.fraction, heights, {}});
  }
}

}  // namespace itin::profile
