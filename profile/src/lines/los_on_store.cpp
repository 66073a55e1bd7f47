#include <utility>

#include <fmt/format.h>

#include <itin/cross_section.hpp>
#include <itin/error.hpp>
#include <itin/height_limit.hpp>
#include <itin/store.hpp>
#include <profile/clearance_error.hpp>
#include <profile/los.hpp>

#include "lines/los_header.hpp"
#include "lines/losses.hpp"

namespace itin::profile {

namespace {

void require_heights(const StoreLine& line, const LosQuery& query) {
  const auto require = [](const char* end, double height, bool is_elevation) {
    require_height(height, fmt::format("`{}_height_m`", end));
    if (height < 0 && !is_elevation)
      throw InputError(
          fmt::format("`{0}_height_m`: a height must not be negative; for an elevation set `{0}_is_elevation`", end),
          fmt::format("{}_height_m", end));
  };
  require("from", query.from_height_m, line.from_is_elevation);
  require("to", query.to_height_m, line.to_is_elevation);
}

constexpr const char* kElevationOverNothing =
    ", and its elevation does not tell whether it is above ground; move it onto the data, or, where it is the sea, "
    "import "
    "with `sea_level`";

void require_ground(const StoreLine& line, const Profile& profile) {
  const auto none_at = [](const char* field, Point2 p, bool is_elevation) {
    return InputError(fmt::format("`{}`: there is no ground at {:.2f},{:.2f}{}", field, p.x, p.y,
                                  is_elevation ? kElevationOverNothing : "; move it onto the data"),
                      field);
  };
  if (profile.points.empty() || profile.points.front().distance_m != 0)
    throw none_at("from", line.from, line.from_is_elevation);
  if (profile.points.back().distance_m != profile.length_m) throw none_at("to", line.to, line.to_is_elevation);
}

/// The height of an antenna at an elevation above what its end stands on.
double height_above(const char* field, double stands_on_m, double elevation_m) {
  if (elevation_m < stands_on_m)
    throw InputError(
        fmt::format("`{}`: elevation {:g} m is below what it stands on, {:.2f} m", field, elevation_m, stands_on_m),
        field);
  return elevation_m - stands_on_m;
}

}  // namespace

LosReport analyse(const Store& store, const StoreLine& line, LosQuery query) {
  require_heights(line, query);
  CrossSection section = cross_section(store, line.from, line.to, line.detail, line.themes);
  Profile profile = from_section(section), ground;
  require_ground(line, profile);
  if (line.themes.includes_raised(store.metadata().themes)) {
    const CrossSection bare = cross_section(store, line.from, line.to, line.detail);
    ground = from_section(bare);
    section.statistics += bare.statistics;
  }
  const EndGrounds grounds = stands_on(profile, ground, query);
  if (line.from_is_elevation) query.from_height_m = height_above("from", grounds.from_m, query.from_height_m);
  if (line.to_is_elevation) query.to_height_m = height_above("to", grounds.to_m, query.to_height_m);
  query.clearance_error_m += clearance_error(store, line.detail, line.themes, line.from, line.to);

  // The budget follows below, for a profile knows neither latitude nor azimuth.
  query.budget.validate();
  const BudgetQuery budget = std::exchange(query.budget, {});
  LosReport report = analyse(std::move(profile), query, std::move(ground));
  report.query.budget = budget;
  const EndGrounds surface = ends_of(report.profile);
  report.from.surface_m = surface.from_m, report.to.surface_m = surface.to_m;
  report.statistics = section.statistics;
  report.triangles = section.triangles;
  add_header(store, line, report);
  const double latitude = (report.from.site->lon_lat.y + report.to.site->lon_lat.y) / 2;
  report.budget = budget_over(report.losses, report.query,
                              {report.profile.length_m, report.antennas, report.from.site->azimuth_grid_deg, latitude});
  return report;
}

}  // namespace itin::profile
