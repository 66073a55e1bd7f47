#include "line/grid_units.hpp"

#include <cmath>

namespace itin::viewshed {

namespace {

double snapped(double units) {
  const double whole = std::round(units);
  return std::abs(units - whole) < 1e-4 ? whole : units;
}

}  // namespace

double easting_in_units(const Grid& grid, double x) {
  return snapped((x - grid.origin.x) / grid.resolution);
}
double northing_in_units(const Grid& grid, double y) {
  return snapped((y - grid.origin.y) / grid.resolution);
}

}  // namespace itin::viewshed
