// A request for a zone of visibility, checked and laid out on the ground.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include <itin/geometry.hpp>
#include <viewshed/turbines.hpp>

namespace itin::viewshed {

/// Checks a request. Throws InputError, naming the turbine or the option.
void validate(const ZoneRequest& request);

/// Returns the zone before any sight line is cast: its turbines on their ground, turbines without ground among the
/// misplaced, and no cell seen, nor screened if `screens`. Its grid covers the part of the outline's box that lies
/// within a radius. The outline is a surface that ends where the ground does, within all sight lines' reach; `ground`
/// gives metres. Throws InputError where no turbine stands on the ground, and where the memory does not hold the
/// results.
Zone lay_out(const ZoneRequest& request, const Tin& outline, const std::function<std::optional<double>(Point2)>& ground,
             bool screens);

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
