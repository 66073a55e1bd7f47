// A request for a zone of visibility, checked and laid out on the ground.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include <itin/geometry.hpp>
#include <viewshed/turbines.hpp>

namespace itin::viewshed {

/// Throws InputError, naming the turbine or the option.
void validate(const ZoneRequest& request);

/// The zone before any line of sight: its turbines on their ground, those without any among the misplaced, its grid
/// over what of the outline's box lies within a radius, and no cell seen, nor with what `screens`. The outline is a
/// surface that ends where the ground does, within all sight lines' reach; `ground` gives metres.
/// Throws InputError where no turbine stands on the ground, and where the memory does not hold the results.
Zone lay_out(const ZoneRequest& request, const Tin& outline, const std::function<std::optional<double>(Point2)>& ground,
             bool screens);

/// The memory of all results of the cells.
std::uint64_t bytes_of_results(const Zone& zone);

/// How far the centre of a cell lies from a turbine in plan, metres squared; whether that is within its radius.
inline double squared_distance(const Turbine& turbine, const RasterGrid& grid, RasterGrid::Cell cell) {
  const double dx = grid.centre_x(cell.column) - turbine.position.x, dy = grid.centre_y(cell.row) - turbine.position.y;
  return dx * dx + dy * dy;
}
inline bool in_reach(const Turbine& turbine, const RasterGrid& grid, RasterGrid::Cell cell) {
  return squared_distance(turbine, grid, cell) <= turbine.radius * turbine.radius;
}

/// Whether any turbine's hub is known: otherwise nothing is said of hubs.
bool knows_hubs(const Zone& zone);

/// What the zone looks at, as observers' fields of view: the turbines' radii.
Request view_of(const ZoneRequest& request);

}  // namespace itin::viewshed
