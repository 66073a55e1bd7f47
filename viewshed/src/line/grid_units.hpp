// Positions in metres as places in grid units.
#pragma once

#include <itin/geometry.hpp>

namespace itin::viewshed {

/// A coordinate within a ten-thousandth of a unit of a whole number is taken for that number: sites and cell centres
/// often are vertices, also at the edge of the data, where rounding would put them outside.
double easting_in_units(const Grid& grid, double x);
double northing_in_units(const Grid& grid, double y);

}  // namespace itin::viewshed
