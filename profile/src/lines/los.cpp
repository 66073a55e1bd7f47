#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include <itin/degrees.hpp>
#include <itin/error.hpp>
#include <itin/grazing.hpp>
#include <profile/los.hpp>

#include "lines/clutter.hpp"
#include "lines/findings.hpp"
#include "lines/losses.hpp"

namespace itin::profile {

namespace {

void add_curves(LosReport& report) {
  const PlannedHeights planned{report.query.from_height_m, report.query.to_height_m};
  const std::vector<NamedRequirement> requirements = requirements_of(report.query, report.profile.length_m);
  for (std::size_t i = 0; i < report.required.size(); ++i) {
    NamedHeights& named = report.required[i];
    named.curve = height_curve(report.profile, planned, requirements[i].requirement, named.heights.both_equal_m,
                               report.stands_on);
  }
}

/// The elevation angle at which something `rise` higher appears at the other end.
double elevation_deg(double rise, const Profile& profile, const Earth& earth) {
  if (!profile.has_length()) return std::abs(rise) <= kGrazing ? 0 : std::copysign(90.0, rise);
  const double distance = profile.length_m;
  return in_degrees(std::atan((rise - earth.drop(distance)) / distance));
}

void describe_ends(LosReport& report) {
  const bool features = !report.ground.points.empty() && !report.bare;
  const EndGrounds ground = ends_of(features ? report.ground : report.profile), surface = ends_of(report.profile);
  const LosQuery& query = report.query;
  report.from.ground_m = ground.from_m, report.to.ground_m = ground.to_m;
  if (features) report.from.surface_m = surface.from_m, report.to.surface_m = surface.to_m;
  report.from.on_surface = query.from_on_surface, report.to.on_surface = query.to_on_surface;
  report.from.height_m = query.from_height_m, report.to.height_m = query.to_height_m;
  report.from.elevation_m = report.antennas.from_m, report.to.elevation_m = report.antennas.to_m;
  const double rise = report.antennas.to_m - report.antennas.from_m;
  report.from.elevation_angle_deg = elevation_deg(rise, report.profile, query.earth);
  report.to.elevation_angle_deg = elevation_deg(-rise, report.profile, query.earth);
}

LineFindings all_findings(const Sight& sight, const LosQuery& query) {
  LineFindings found = findings(sight, query);
  add_obstructions(sight, query, found);
  add_required_heights(sight, query, found);
  return found;
}

bool has_clutter(const Profile& profile) {
  return std::any_of(profile.points.begin(), profile.points.end(),
                     [](const ProfilePoint& p) { return p.clutter_m > 0; });
}

}  // namespace

const char* name_of(SightVerdict verdict) {
  constexpr const char* kNames[] = {"visible", "hidden", "undecided"};
  return kNames[static_cast<int>(verdict)];
}

const char* name_of(CriterionVerdict verdict) {
  constexpr const char* kNames[] = {"meets", "fails", "undecided"};
  return kNames[static_cast<int>(verdict)];
}

EndGrounds stands_on(const Profile& profile, const Profile& ground, const LosQuery& query) {
  EndGrounds grounds = ends_of(profile);
  if (ground.points.empty()) return grounds;
  if (!query.from_on_surface) grounds.from_m = ends_of(ground).from_m;
  if (!query.to_on_surface) grounds.to_m = ends_of(ground).to_m;
  return grounds;
}

LineFindings judge(const Profile& profile, const LosQuery& query, const Profile& ground) {
  require_valid(profile, query, ground);
  const EndGrounds ends = stands_on(profile, ground, query);
  return findings({profile, antennas_on(ends, query), ends}, query);
}

LosReport analyse(Profile profile, const LosQuery& query, Profile ground) {
  require_valid(profile, query, ground);
  const bool clutter = ground.points.empty() && has_clutter(profile);
  if (clutter) ground = std::move(profile), profile = clutter_raised(ground);
  LosReport report;
  report.query = query;
  report.stands_on = stands_on(profile, ground, query);
  report.profile = std::move(profile);
  report.ground = std::move(ground);
  report.antennas = antennas_on(report.stands_on, query);
  if (clutter) {
    report.themes = {"terrain", "clutter"};
    report.bare = all_findings({report.ground, report.antennas, report.stands_on}, query);
  }
  static_cast<LineFindings&>(report) = all_findings({report.profile, report.antennas, report.stands_on}, query);
  add_curves(report);
  // Clutter counts for the losses alone, whose horizons and smooth heights leave it out.
  const Profile* under = report.ground.points.empty() ? nullptr : &report.ground;
  report.losses =
      losses_over(clutter ? report.ground : report.profile, report.antennas, query, clutter ? nullptr : under);
  report.budget = budget_over(report.losses, query, {report.profile.length_m, report.antennas});
  if (query.radio) report.reflection = reflection(report.profile, report.antennas, *query.radio, under);
  describe_ends(report);
  if (query.object) {
    report.visible = visible_height(report.profile, query.from_height_m, *query.object, query.earth, report.stands_on);
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
  return known == report.features.end() ? name : name + ", " + title_of(known->second);
}

}  // namespace itin::profile
