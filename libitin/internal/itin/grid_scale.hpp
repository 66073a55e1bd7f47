// How lengths on a projected CRS's grid compare with those on the ground.
//
//   grid_scale("EPSG:3857", {-350000, 6700000, -340000, 6710000})->greatest    // 1.60: web Mercator in Wales
//
// A store's lengths are lengths on its grid. UTM zones are true to 0.1 %, and national grids to 0.5 % wherever they are
// used (Lambert-93 is 0.3 % too long in Corsica, and 0.4 % are Norway's at Vardo and Spain's at Menorca), and are taken
// as they are. Mercator's projection, and others about the equator that show the whole world, must be true to 0.2 %.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include <itin/geometry.hpp>

namespace itin {

/// Where lengths are wrong by more than this, an import takes no CRS for a store: in general, and in a CRS about the
/// equator.
inline constexpr double kGreatestScaleError = 0.005, kGreatestScaleErrorOfWorld = 0.002;

/// Distance on the grid over the geodesic one on the CRS's own ellipsoid, for short lines in whatever direction.
struct GridScale {
  double least = 1, greatest = 1;
  double allowed = kGreatestScaleError;  ///< error, in this CRS

  double error() const { return std::max(std::abs(least - 1), std::abs(greatest - 1)); }
  bool is_true() const { return error() <= allowed; }
};

/// "up to 60.4 % too long".
std::string error_in_words(const GridScale& scale);

/// The extremes at the box's corners, its middle and between them, 25 places in all, to about one part in a million.
/// Nothing where none of them has a place on the ground. Throws InputError for a CRS that is not understood, or whose
/// axes are not in metres.
std::optional<GridScale> grid_scale(const std::string& crs, const Box& area);

}  // namespace itin
