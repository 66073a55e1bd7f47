#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <itin/degrees.hpp>
#include <itin/error.hpp>
#include <itin/precondition.hpp>
#include <profile/antenna_loss.hpp>
#include <profile/diffraction.hpp>
#include <profile/gas_loss.hpp>
#include <profile/multipath_fading.hpp>
#include <profile/rain_loss.hpp>

namespace itin::profile {

namespace {

constexpr double kMinutesInYear = 365.25 * 24 * 60;
/// A pattern is taken as one of the link's band up to this ratio of frequencies.
constexpr double kNearBand = 1.5;

/// A link in the units of the recommendations.
struct BudgetPath {
  RainPath rain;
  MultipathPath multipath;
  bool in_sight;
};

BudgetPath budget_path(const PathLosses& losses, const RadioPath& path, const BudgetCourse& course) {
  const double km = course.length_m / 1000;
  const double rise = std::abs(course.antennas.to_m - course.antennas.from_m);
  return {{path.frequency_ghz, path.polarisation, km, std::atan(rise / course.length_m)},
          {path.frequency_ghz, km, rise / km, std::min(course.antennas.from_m, course.antennas.to_m)},
          !losses.horizons.trans_horizon};
}

double gain_of(const AimedAntenna& antenna, const std::optional<double>& given) {
  if (given || !antenna.pattern) return given.value_or(0);
  if (!antenna.pattern->gain_dbi)
    throw InputError("`gain_dbi`: the file of the antenna's pattern has no gain; give it", "gain_dbi");
  return *antenna.pattern->gain_dbi;
}

/// Refuses a pattern that was measured far from the link's frequency: it is that of another antenna.
void require_near_band(const AimedAntenna& antenna, const RadioPath& path) {
  if (!antenna.pattern || !antenna.pattern->frequency_mhz) return;
  const double measured = *antenna.pattern->frequency_mhz, used = 1000 * path.frequency_ghz;
  const auto is_near = [&](double mhz) { return mhz > used / kNearBand && mhz < used * kNearBand; };
  // Some files state GHz without saying so.
  if (is_near(measured) || is_near(1000 * measured)) return;
  throw InputError(
      fmt::format("{}: the pattern is one at {:g} MHz, and the radio works at {:g} MHz; name the pattern "
                  "of that band",
                  antenna.pattern->path, measured, used));
}

/// What an antenna loses towards the other end, which is at this azimuth and `rise_m` higher.
double off_axis_of(const AimedAntenna& antenna, const std::optional<double>& azimuth_deg, double rise_m,
                   const BudgetCourse& course, const RadioPath& path) {
  if (!antenna.pattern) return 0;
  if (antenna.azimuth_deg && !azimuth_deg)
    throw InputError("`antenna_azimuth` needs a line whose ends have positions; a profile from a file has none",
                     "antenna_azimuth");
  const double drop = course.length_m / (2000 * path.effective_earth_km);
  const double elevation = in_degrees(std::atan(rise_m / course.length_m - drop));
  const double beside = antenna.azimuth_deg ? *azimuth_deg - *antenna.azimuth_deg : 0;
  return off_axis_db(*antenna.pattern, {beside, elevation}, antenna.tilt_deg.value_or(-elevation));
}

void add_antennas(const BudgetQuery& query, const BudgetCourse& course, const RadioPath& path, LinkBudget& budget) {
  require_near_band(query.from_antenna, path);
  require_near_band(query.to_antenna, path);
  const double rise = course.antennas.to_m - course.antennas.from_m;
  const auto back = course.azimuth_deg ? std::optional(*course.azimuth_deg + 180) : std::nullopt;
  if (query.power_dbm) budget.from_gain_dbi = gain_of(query.from_antenna, query.from_gain_dbi);
  budget.to_gain_dbi = gain_of(query.to_antenna, query.to_gain_dbi);
  budget.eirp_dbm =
      query.eirp_dbm ? *query.eirp_dbm : *query.power_dbm + budget.from_gain_dbi - query.from_feeder_db.value_or(0);
  budget.from_off_axis_db = off_axis_of(query.from_antenna, course.azimuth_deg, rise, course, path);
  budget.to_off_axis_db = off_axis_of(query.to_antenna, back, -rise, course, path);
}

void add_gases(const BudgetPath& path, LinkBudget& budget) {
  const double ghz = path.rain.frequency_ghz;
  if (ghz < kGasesFrom || ghz > kGasesTo) {
    budget.left_out.push_back(
        fmt::format("gases ({:g} GHz is outside of {:g} to {:g} GHz, the range of P.676)", ghz, kGasesFrom, kGasesTo));
    return;
  }
  budget.gases_db = gas_loss(ghz).both_db_km() * path.rain.length_km;
}

/// Why rain is left out; empty where it is not.
std::string why_no_rain(const BudgetPath& path, const BudgetQuery& query) {
  const double ghz = path.rain.frequency_ghz, km = path.rain.length_km;
  if (!query.rain_rate_mm_h) return "no rate is given";
  if (ghz < kRainFrom || ghz > kRainTo)
    return fmt::format("{:g} GHz is outside of {:g} to {:g} GHz, the range of P.530", ghz, kRainFrom, kRainTo);
  if (km > kLongestInRain) return fmt::format("{:.1f} km is beyond {:g} km, the range of P.530", km, kLongestInRain);
  return "";
}

void add_rain(const BudgetPath& path, const BudgetQuery& query, LinkBudget& budget) {
  if (const std::string why = why_no_rain(path, query); !why.empty()) {
    budget.left_out.push_back(fmt::format("rain ({})", why));
    return;
  }
  budget.rain = rain_loss(path.rain, *query.rain_rate_mm_h);
  if (budget.margin_db && *budget.margin_db > 0)
    budget.rain_outage = rain_outage(*budget.rain, path.rain.frequency_ghz, *budget.margin_db);
}

/// Why multipath is left out; empty where it is not.
std::string why_no_multipath(const BudgetPath& path, const BudgetQuery& query) {
  const double ghz = path.multipath.frequency_ghz, km = path.multipath.length_km;
  if (!query.geoclimatic_factor && !query.refractivity_gradient)
    return "neither a geoclimatic factor nor a gradient of refractivity is given";
  if (km <= kShortestToFade) return "";
  if (!path.in_sight) return "the path is trans-horizon, and P.530 is for paths in sight";
  const double least = kMultipathLength / km;
  if (ghz < least || ghz > kMultipathTo)
    return fmt::format("{:g} GHz is outside of {:.2g} to {:g} GHz, the range of P.530 for {:.1f} km", ghz, least,
                       kMultipathTo, km);
  return "";
}

/// Adds the parts of the worst month and of the year in which fades are deeper than the margin.
void add_multipath_outage(const MultipathPath& path, const BudgetCourse& course, LinkBudget& budget) {
  const double p0 = budget.multipath->occurrence_percent, margin = *budget.margin_db;
  const auto exceeded = [&](double part) { return p0 > 0 ? multipath_exceeded(p0, margin, part) : 0; };
  const double month = exceeded(1);
  budget.multipath->worst_month_percent = month;
  if (course.latitude_deg && p0 > 0) {
    budget.multipath_outage = {exceeded(year_of_month(path, *course.latitude_deg)), false};
  } else {
    budget.multipath_outage = {month, month > 0};
  }
}

void add_multipath(const BudgetPath& path, const BudgetCourse& course, const BudgetQuery& query, LinkBudget& budget) {
  if (const std::string why = why_no_multipath(path, query); !why.empty()) {
    budget.left_out.push_back(fmt::format("multipath ({})", why));
    return;
  }
  const double factor =
      query.geoclimatic_factor ? *query.geoclimatic_factor : geoclimatic_factor(*query.refractivity_gradient);
  const bool fades = path.multipath.length_km > kShortestToFade;
  budget.multipath = {factor, fades ? multipath_occurrence(path.multipath, factor) : 0, {}};
  if (budget.margin_db && *budget.margin_db > 0) add_multipath_outage(path.multipath, course, budget);
}

/// Why there is no availability; empty where there is one.
std::string why_no_availability(const LinkBudget& budget) {
  if (!budget.margin_db) return "no sensitivity is given";
  if (*budget.margin_db <= 0) return "the level in clear air is not above the sensitivity";
  if (!budget.rain && !budget.multipath) return "neither rain nor multipath is counted";
  if (budget.rain && !budget.rain_outage)
    return "for more than 1 % of the year rain takes more than the margin, and P.530 tells no more";
  return "";
}

void add_availability(LinkBudget& budget) {
  if (const std::string why = why_no_availability(budget); !why.empty()) {
    budget.left_out.push_back(fmt::format("availability ({})", why));
    return;
  }
  const Outage rain = budget.rain_outage.value_or(Outage()), multipath = budget.multipath_outage.value_or(Outage());
  const double out = std::min(rain.percent + multipath.percent, 100.0);
  budget.availability = {100 - out, out / 100 * kMinutesInYear, rain.at_most || multipath.at_most};
}

}  // namespace

LinkBudget link_budget(const PathLosses& losses, const RadioPath& path, const BudgetCourse& course,
                       const BudgetQuery& query) {
  ITIN_PRECONDITION(query.asks());
  query.validate();
  const BudgetPath of = budget_path(losses, path, course);
  LinkBudget budget;
  add_antennas(query, course, path, budget);
  budget.free_space_db = losses.free_space_db, budget.diffraction_db = losses.ld_db;
  add_gases(of, budget);
  budget.level_dbm = budget.eirp_dbm - budget.from_off_axis_db - budget.free_space_db - budget.diffraction_db -
                     budget.gases_db.value_or(0) + budget.to_gain_dbi - budget.to_off_axis_db -
                     query.to_feeder_db.value_or(0);
  if (query.sensitivity_dbm) budget.margin_db = budget.level_dbm - *query.sensitivity_dbm;
  add_rain(of, query, budget);
  add_multipath(of, course, query, budget);
  add_availability(budget);
  return budget;
}

}  // namespace itin::profile
