// What stands along the edge of a surface, so that no ray passes it unnoticed: walls under it against rays from outside
// to beneath, and boxes about it against rays that run beside their lines.
#pragma once

#include <cstdint>
#include <vector>

#include <itin/tin.hpp>

#include "bounds/boundary.hpp"
#include "scene/rays/tessellation.hpp"

namespace itin::viewshed {

/// Triangles in single precision, as Embree takes them.
struct Barrier {
  std::vector<float> vertices;
  std::vector<std::uint32_t> indices;
};

inline constexpr std::uint32_t kTrianglesPerWall = 2;

/// A wall under each edge of the boundary, in order, from below everything up to the surface.
Barrier walls_under(const Tin& tin, const std::vector<BoundaryEdge>& boundary, const Tessellation& tessellation,
                    double drop);

/// The faces of a box along an edge, of two triangles each; `kRight` is where the surface is not.
enum class BoxFace : std::uint8_t { kRight, kLeft, kAhead, kBack, kTop };
inline constexpr std::uint32_t kTrianglesPerBox = 10;

/// A box about each wall, `margin` grid units to both sides of it and beyond both ends, in order.
Barrier boxes_about(const Tin& tin, const std::vector<BoundaryEdge>& boundary, const Tessellation& tessellation,
                    double drop, double margin);

}  // namespace itin::viewshed
