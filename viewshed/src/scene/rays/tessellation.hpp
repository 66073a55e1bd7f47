// A Tin as single-precision triangles for ray casting, about its centre and lowered by the Earth's curvature.
//
// Lowering every vertex by drop(distance to a fixed centre) makes sight lines straight for every observer at once: the
// drops about two centres differ by an affine function. A triangle's chord then lies below the curved ground by at
// most c L^2 / 3 for its longest edge L, so longer edges than the sag allows are halved until they fit. The rule looks
// at an edge alone, so the triangles on both sides halve it alike and no gap opens between them.
#pragma once

#include <cstdint>
#include <vector>

#include <itin/tin.hpp>

namespace itin::viewshed {

/// The tessellation lies below the curved ground by no more than this, metres.
inline constexpr double kSag = 0.004;

struct Tessellation {
  GridPoint centre;                    ///< z: middle of the heights
  std::vector<float> vertices;         ///< x, y, z in grid units about the centre
  std::vector<std::uint32_t> indices;  ///< three per triangle
  std::vector<std::uint32_t> parents;  ///< for each triangle the Tin's that it is cut from; empty when none was cut
  double half_width = 0;               ///< greatest |x| or |y|, grid units
  double half_height = 0;              ///< greatest |z|, grid units
};

/// `drop` is the drop's coefficient per grid unit: grid units of drop per squared grid unit of distance.
Tessellation tessellate(const Tin& tin, double drop);

}  // namespace itin::viewshed
