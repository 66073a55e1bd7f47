// Positions in metres as places in grid units, and back.
//
//   const Point2 units = place_in_units(store.metadata().grid, {318000.25, 176000.5});
//   const Point2 metres = place_in_metres(store.metadata().grid, units);
#pragma once

#include <cmath>

#include <itin/geometry.hpp>

namespace itin {

/// Returns a value within a ten-thousandth of a unit of a whole number as that number. Sites and cell centres often are
/// vertices, also at the edge of the data, where rounding would put them outside.
inline double snapped_to_units(double units) {
  const double whole = std::round(units);
  return std::abs(units - whole) < 1e-4 ? whole : units;
}

inline double easting_in_units(const Grid& grid, double x) {
  return snapped_to_units((x - grid.origin.x) / grid.resolution);
}
inline double northing_in_units(const Grid& grid, double y) {
  return snapped_to_units((y - grid.origin.y) / grid.resolution);
}
inline Point2 place_in_units(const Grid& grid, Point2 p) {
  return {easting_in_units(grid, p.x), northing_in_units(grid, p.y)};
}
inline Point2 place_in_metres(const Grid& grid, Point2 units) {
  return {grid.origin.x + units.x * grid.resolution, grid.origin.y + units.y * grid.resolution};
}

}  // namespace itin
