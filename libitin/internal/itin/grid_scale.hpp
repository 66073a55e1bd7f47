// How lengths on a projected CRS's grid compare with those on the ground.
//
//   grid_scale("EPSG:3857", {-350000, 6700000, -340000, 6710000})->greatest    // 1.60: web Mercator in Wales
//
// A store's lengths are lengths on its grid. UTM zones are true to 0.1 %, and national grids to 0.5 % wherever they are
// used (Lambert-93 is 0.3 % too long in Corsica; Norway's grid at Vardo and Spain's at Menorca are 0.4 % too long), and
// are accepted as they are. Mercator's projection, and others about the equator that show the whole world, must be true
// to 0.2 %.
#pragma once

#include <optional>
#include <string>

#include <itin/coordinates.hpp>
#include <itin/geometry.hpp>

namespace itin {

/// Returns "up to 60.4 % too long".
std::string error_in_words(const GridScale& scale);

/// Returns the extremes at 25 places: the box's corners, its middle and places between them; good to about one part in
/// a million. Nothing where the CRS puts none of the places on the Earth. Throws InputError for a CRS that is not
/// understood, or whose axes are not in metres.
std::optional<GridScale> grid_scale(const std::string& crs, const Box& area);

/// Returns what grid_scale() does, and nothing where that throws InputError.
std::optional<GridScale> grid_scale_if_known(const std::string& crs, const Box& area);

}  // namespace itin
