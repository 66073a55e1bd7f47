#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <itin/counted.hpp>
#include <profile/budget_text.hpp>
#include <profile/multipath_fading.hpp>

namespace itin::profile {

namespace {

/// Names what is lost besides the path: " with 0.2 dB lost to gases and 3.0 dB off the axes of antennas"; or nothing.
std::string small_losses_text(const LinkBudget& budget) {
  std::vector<std::string> losses;
  if (budget.gases_db) losses.push_back(fmt::format("{:.1f} dB lost to gases", *budget.gases_db));
  if (const double off = budget.from_off_axis_db + budget.to_off_axis_db; off != 0)
    losses.push_back(fmt::format("{:.1f} dB lost off the axes of antennas", off));
  return losses.empty() ? "" : fmt::format(" with {}", listed(losses));
}

std::string level_line(const LinkBudget& budget) {
  const std::string line = fmt::format("link budget: EIRP {:.1f} dBm, level {:.1f} dBm{}", budget.eirp_dbm,
                                       budget.level_dbm, small_losses_text(budget));
  if (!budget.margin_db) return line;
  return line + fmt::format("; {:.1f} dB {} the sensitivity", std::abs(*budget.margin_db),
                            *budget.margin_db < 0 ? "below" : "above");
}

std::string rain_line(const LinkBudget& budget) {
  std::string line = fmt::format("rain: {:.1f} dB exceeded for 0.01 % of the year", budget.rain->exceeded_db);
  if (budget.rain_outage) line += fmt::format("; out for {} of the year", outage_text(*budget.rain_outage));
  return line;
}

std::string multipath_line(const LinkBudget& budget) {
  if (budget.multipath->occurrence_percent == 0) return "multipath: " + no_multipath_text();
  std::string line = fmt::format("multipath: occurrence {} %", significant(budget.multipath->occurrence_percent, 3));
  if (!budget.multipath_outage) return line;
  return line + fmt::format("; out for {} % of the worst month, {} of the year",
                            significant(*budget.multipath->worst_month_percent, 2),
                            outage_text(*budget.multipath_outage));
}

}  // namespace

std::string outage_text(const Outage& outage) {
  return fmt::format("{}{} %", outage.at_most ? "at most " : "", significant(outage.percent, 2));
}

std::string availability_text(const Availability& availability) {
  constexpr double kLeastDigits = 2, kMostDigits = 9;
  const double out = 100 - availability.percent;
  const double digits = out > 0 ? std::clamp(1 + std::ceil(-std::log10(out)), kLeastDigits, kMostDigits) : 0;
  return fmt::format("{}{:.{}f} %", availability.at_least ? "at least " : "", availability.percent,
                     static_cast<int>(digits));
}

std::string minutes_text(const Availability& availability) {
  return fmt::format("{}{} minutes a year", availability.at_least ? "at most " : "",
                     significant(availability.outage_minutes, 3));
}

std::string no_multipath_text() {
  return fmt::format("none up to {:g} km", kShortestToFade);
}

std::string not_counted_text(const LinkBudget& budget) {
  std::vector<std::string> all = budget.left_out;
  all.emplace_back(kNeverInBudgets);
  return fmt::format("{}", fmt::join(all, "; "));
}

std::string radios_text(const BudgetQuery& query) {
  std::string text =
      query.eirp_dbm ? fmt::format("EIRP {:g} dBm", *query.eirp_dbm) : fmt::format("power {:g} dBm", *query.power_dbm);
  const auto add = [&](const char* what, const char* unit, const std::optional<double>& value) {
    if (value) text += fmt::format(", {} {:g} {}", what, *value, unit);
  };
  add("gain", "dBi", query.from_gain_dbi);
  add("feeder loss", "dB", query.from_feeder_db);
  add("gain of the receiver", "dBi", query.to_gain_dbi);
  add("its feeder loss", "dB", query.to_feeder_db);
  if (query.sensitivity_dbm) text += fmt::format(", sensitivity {:g} dBm", *query.sensitivity_dbm);
  const auto add_aim = [&](const char* whose, const AimedAntenna& antenna) {
    if (antenna.azimuth_deg) text += fmt::format(", {} towards {:g}°", whose, *antenna.azimuth_deg);
    if (antenna.tilt_deg) text += fmt::format(", {} tilted {:g}° down", whose, *antenna.tilt_deg);
  };
  add_aim("antenna", query.from_antenna);
  add_aim("antenna of the receiver", query.to_antenna);
  return text;
}

std::vector<std::string> budget_lines(const LinkBudget& budget) {
  std::vector<std::string> lines{level_line(budget)};
  if (budget.rain) lines.push_back(rain_line(budget));
  if (budget.multipath) lines.push_back(multipath_line(budget));
  if (budget.availability)
    lines.push_back(fmt::format("availability {}, out for {}", availability_text(*budget.availability),
                                minutes_text(*budget.availability)));
  lines.push_back("not counted: " + not_counted_text(budget));
  return lines;
}

}  // namespace itin::profile
