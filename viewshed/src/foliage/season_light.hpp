// Whether enough light comes through woods in a season.
#pragma once

#include <cmath>

#include <viewshed/turbines.hpp>

namespace itin::viewshed {

/// Tells whether something is seen through so many metres of foliage of a leaf area.
inline bool comes_through(const ZoneFoliage& foliage, double leaf_area, double length_m) {
  return std::exp(-foliage.extinction * leaf_area * length_m) >= foliage.least_transmittance;
}

}  // namespace itin::viewshed
