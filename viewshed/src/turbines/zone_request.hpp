// A request for a zone of visibility, checked and laid out on the ground.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include <itin/geometry.hpp>
#include <itin/progress.hpp>
#include <itin/store.hpp>
#include <viewshed/turbines.hpp>

namespace itin::viewshed {

/// Checks a request. Throws InputError, naming the turbine or the option.
void validate(const ZoneRequest& request);

/// Returns the zone before any sight line is cast, without room for what is seen: its turbines on their ground,
/// turbines without ground among the misplaced; it is screened if `screens`. Its grid covers the part of the outline's
/// box that lies within a radius. The outline is a surface that ends where the ground does, within all sight lines'
/// reach; `ground` gives metres. Throws InputError where no turbine stands on the ground.
Zone placed_zone(const ZoneRequest& request, const Tin& outline,
                 const std::function<std::optional<double>(Point2)>& ground, bool screens);

/// Returns the same over the surface of a store. Also checks the request, as validate() does.
Zone placed_zone(const Store& store, const ZoneRequest& request, Progress& progress);

/// Makes room in a placed zone for what is seen; nothing is seen from any cell yet. Throws InputError where the memory
/// does not hold the results.
void make_room(Zone& zone);

/// Where themes were asked for of which nothing screens, says so, and that as much is seen as over the bare ground.
void complete_screen(Zone& zone);

/// Returns the share that so many tips are of all turbines.
inline float share_of_turbines(std::uint16_t tips, std::size_t turbines) {
  return static_cast<float>(tips / static_cast<double>(turbines));
}

/// Returns the memory that the results of all cells take.
std::uint64_t bytes_of_results(const Zone& zone);
/// Returns the memory that results and shadows of ground without data take.
std::uint64_t bytes_beside_surfaces(const Zone& zone);

/// Return how far the centre of a cell lies from a turbine in plan, metres squared; and whether that is within its
/// radius.
inline double squared_distance(const Turbine& turbine, const RasterGrid& grid, RasterGrid::Cell cell) {
  const double dx = grid.centre_x(cell.column) - turbine.position.x, dy = grid.centre_y(cell.row) - turbine.position.y;
  return dx * dx + dy * dy;
}
inline bool in_reach(const Turbine& turbine, const RasterGrid& grid, RasterGrid::Cell cell) {
  return squared_distance(turbine, grid, cell) <= turbine.radius * turbine.radius;
}

/// Returns a request whose observers' fields of view are the discs of the turbines' radii.
Request view_of(const ZoneRequest& request);

}  // namespace itin::viewshed
