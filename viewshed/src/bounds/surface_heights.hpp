// Heights of a Tin's surface at cell centres and at single positions, in double precision.
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <span>

#include <itin/tin.hpp>
#include <itin/tin_heights.hpp>

#include "line/cell_tiles.hpp"
#include "line/infinity.hpp"

namespace itin::viewshed {

inline constexpr double kNoSurface = std::numeric_limits<double>::quiet_NaN();
/// The height of ground that was not read, since no eye sees it.
inline constexpr double kUnread = -kInfinity;

/// Heights in grid units at the tile's cell centres, kNoSurface where no triangle lies. Each centre is given its height
/// by the first of `triangles` that holds it; triangles are closed, so none falls between two.
void scan_convert(const Tin& tin, std::span<const std::uint32_t> triangles, const Tile& tile,
                  const TileCentres& centres, TileValues<double>& heights);

/// Does the same for triangles that may overlap: a centre gets the greatest height.
void scan_convert_highest(const Tin& tin, std::span<const std::uint32_t> triangles, const Tile& tile,
                          const TileCentres& centres, TileValues<double>& heights);

/// Height in grid units at a position in metres, if one of `triangles` holds it.
std::optional<double> surface_height(const Tin& tin, std::span<const std::uint32_t> triangles, Point2 position);

/// A square whose diagonal runs from north-west to south-east; heights are those of its corners, all in grid units.
struct FallingSquare {
  std::int32_t west = 0, south = 0, side = 0;
  std::int32_t sw = 0, se = 0, nw = 0, ne = 0;
};

/// The height that height_over() gives, to the last bit, over the two triangles of a square, the south-western one
/// first. Precondition: the position lies within the square, and on none of its sides.
double height_over(const FallingSquare& square, Point2 units);

}  // namespace itin::viewshed
