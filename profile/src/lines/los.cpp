#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>

#include <itin/error.hpp>
#include <itin/grazing.hpp>
#include <profile/los.hpp>

#include "lines/line_clearance.hpp"
#include "lines/sight_verdict.hpp"

namespace itin::profile {

namespace {

/// Formulas that look at points only see the profile at least this finely.
constexpr double kMostSpacingM = 100;
constexpr int kLeastPoints = 50;

double degrees(double radians) {
  return radians * 180 / std::numbers::pi;
}

double factor_of(const Earth& earth) {
  const double drop = earth.drop_coefficient();
  return drop == 0 ? std::numeric_limits<double>::infinity() : 1 / (2 * drop * earth.radius);
}

Earth earth_of(const Criterion& criterion, const Earth& earth) {
  Earth result = Earth::effective_earth(criterion.k);
  result.radius = earth.radius;
  return result;
}

double wavelength_of(const LosQuery& query) {
  return query.radio ? wavelength_m(query.radio->frequency_ghz) : 0;
}

void require_valid(const Profile& profile, const LosQuery& query, const Profile& ground) {
  if (!has_ground_at_ends(profile) || (!ground.points.empty() && !has_ground_at_ends(ground))) {
    throw InputError("there is no ground at an end of the line; move it onto the data");
  }
  if (!(query.from_height_m >= 0) || !(query.to_height_m >= 0)) throw InputError("a height above ground is negative");
  for (const Criterion& c : query.criteria) {
    if (c.fraction > 0 && !query.radio) {
      throw InputError("a criterion with a fraction of the Fresnel zone takes a frequency");
    }
  }
}

/// The least of the fractions of F1, or without a wavelength a sign, with both antennas `shift` metres higher: lifting
/// the ray is lowering the surface.
struct Margin {
  std::optional<double> clearance_m, fraction;
  bool cut() const { return clearance_m && *clearance_m < -kGrazing; }
  bool meets(const Criterion& c) const { return !cut() && (c.fraction == 0 || !fraction || *fraction >= c.fraction); }
};
Margin margin(const LosReport& report, const Earth& earth, double shift) {
  const Antennas antennas{report.antennas.from_m + shift, report.antennas.to_m + shift};
  Margin result;
  if (const auto line = line_clearance(report.profile, antennas, earth)) result.clearance_m = line->clearance_m;
  if (!report.query.radio) return result;
  const auto fresnel = fresnel_clearance(report.profile, antennas, earth, wavelength_of(report.query));
  if (fresnel) result.fraction = fresnel->fraction;
  return result;
}

/// Certain verdicts hold whatever the surface's certified error hides.
CriterionVerdict criterion_verdict(const LosReport& report, const Criterion& criterion, const Earth& earth) {
  if (!report.profile.has_length()) return CriterionVerdict::kClear;
  const double error = report.query.clearance_error_m;
  const Margin least = margin(report, earth, -error), most = margin(report, earth, error);
  if (most.cut()) return CriterionVerdict::kObstructed;
  if (least.meets(criterion)) return CriterionVerdict::kClear;
  return !least.cut() && !most.meets(criterion) ? CriterionVerdict::kMarginal : CriterionVerdict::kUndecided;
}

CriterionResult judge(const LosReport& report, const Criterion& criterion) {
  const Earth earth = earth_of(criterion, report.query.earth);
  const Margin as_is = margin(report, earth, 0);
  return {criterion, criterion_verdict(report, criterion, earth), as_is.clearance_m, as_is.fraction};
}

std::string criterion_name(const Criterion& c) {
  return fmt::format("K = {:.4g}, {:.3g} F1", c.k, c.fraction);
}

void add_required(LosReport& report) {
  if (!report.profile.has_length()) return;
  const PlannedHeights planned{report.query.from_height_m, report.query.to_height_m};
  const auto add = [&](std::string name, const Earth& earth, double fraction) {
    const Requirement requirement{earth, fraction, wavelength_of(report.query)};
    report.required.push_back({std::move(name), factor_of(earth), fraction,
                               required_heights(report.profile, planned, requirement, report.stands_on)});
  };
  add("line of sight", report.query.earth, 0);
  if (report.query.radio) add("0.6 F1", report.query.earth, 0.6);
  for (const Criterion& c : report.query.criteria) {
    add(criterion_name(c), earth_of(c, report.query.earth), c.fraction);
  }
}

void describe_ends(LosReport& report) {
  const bool features = !report.ground.points.empty();
  const EndGrounds ground = ends_of(features ? report.ground : report.profile), surface = ends_of(report.profile);
  const LosQuery& query = report.query;
  report.from.ground_m = ground.from_m, report.to.ground_m = ground.to_m;
  if (features) report.from.surface_m = surface.from_m, report.to.surface_m = surface.to_m;
  report.from.on_surface = query.from_on_surface, report.to.on_surface = query.to_on_surface;
  report.from.height_m = query.from_height_m, report.to.height_m = query.to_height_m;
  report.from.elevation_m = report.antennas.from_m, report.to.elevation_m = report.antennas.to_m;
}

bool above_surface(const Profile& profile, const Antennas& antennas) {
  return antennas.from_m >= profile.points.front().ground_m && antennas.to_m >= profile.points.back().ground_m;
}

/// The elevation angle at which something `rise` higher appears at the other end.
double elevation_deg(double rise, const Profile& profile, const Earth& earth) {
  if (!profile.has_length()) return std::abs(rise) <= kGrazing ? 0 : std::copysign(90.0, rise);
  const double distance = profile.length_m;
  return degrees(std::atan((rise - earth.drop(distance)) / distance));
}

void add_radio(LosReport& report) {
  const LosQuery& query = report.query;
  if (!query.radio || !report.profile.has_length()) return;
  report.fresnel = fresnel_clearance(report.profile, report.antennas, query.earth, wavelength_of(query));
  if (!above_surface(report.profile, report.antennas)) return;
  const double spacing = std::min(kMostSpacingM, report.profile.length_m / kLeastPoints);
  report.losses = path_losses(query.points_as_given ? report.profile : with_spacing(report.profile, spacing),
                              report.antennas, *query.radio, report.ground.points.empty() ? nullptr : &report.ground);
}

}  // namespace

const char* name_of(SightVerdict verdict) {
  constexpr const char* kNames[] = {"visible", "hidden", "undecided"};
  return kNames[static_cast<int>(verdict)];
}

const char* name_of(CriterionVerdict verdict) {
  constexpr const char* kNames[] = {"clear", "marginal", "obstructed", "undecided"};
  return kNames[static_cast<int>(verdict)];
}

EndGrounds stands_on(const Profile& profile, const Profile& ground, const LosQuery& query) {
  EndGrounds grounds = ends_of(profile);
  if (ground.points.empty()) return grounds;
  if (!query.from_on_surface) grounds.from_m = ends_of(ground).from_m;
  if (!query.to_on_surface) grounds.to_m = ends_of(ground).to_m;
  return grounds;
}

LosReport analyse(Profile profile, const LosQuery& query, Profile ground) {
  require_valid(profile, query, ground);
  LosReport report;
  report.query = query;
  report.stands_on = stands_on(profile, ground, query);
  report.profile = std::move(profile);
  report.ground = std::move(ground);
  report.antennas = {report.stands_on.from_m + query.from_height_m, report.stands_on.to_m + query.to_height_m};
  describe_ends(report);
  if (auto line = line_clearance(report.profile, report.antennas, query.earth)) {
    report.clearance_m = line->clearance_m;
    report.critical = line->critical;
    report.obstructions = std::move(line->obstructions);
  }
  report.verdict = sight_verdict(report.profile, report.clearance_m, {query.clearance_error_m, query.gaps_block});
  const double rise = report.antennas.to_m - report.antennas.from_m;
  report.from.elevation_angle_deg = elevation_deg(rise, report.profile, query.earth);
  report.to.elevation_angle_deg = elevation_deg(-rise, report.profile, query.earth);
  for (const Criterion& c : query.criteria) report.criteria.push_back(judge(report, c));
  add_required(report);
  add_radio(report);
  if (query.object) {
    report.visible = visible_height(report.profile, query.from_height_m, query.object->hub_m, query.object->tip_m,
                                    query.earth, report.stands_on);
  }
  return report;
}

Point2 position_at(const LosReport& report, double distance_m) {
  const ProfilePoint &a = report.profile.points.front(), &b = report.profile.points.back();
  const double t = report.profile.length_m > 0 ? distance_m / report.profile.length_m : 0;
  return {a.x + (b.x - a.x) * t, a.y + (b.y - a.y) * t};
}

double ray_elevation_m(const LosReport& report, double distance_m) {
  const double t = report.profile.length_m > 0 ? distance_m / report.profile.length_m : 0;
  return report.antennas.from_m * (1 - t) + report.antennas.to_m * t;
}

std::string cause_of(const LosReport& report, std::uint16_t theme, std::int64_t feature) {
  if (theme == 0) return "terrain";
  const std::string name = theme < report.themes.size() ? report.themes[theme] : fmt::format("theme {}", theme);
  const auto known = report.features.find({theme, feature});
  return known == report.features.end() ? name : name + ", " + known->second;
}

}  // namespace itin::profile
