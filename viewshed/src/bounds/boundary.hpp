// The boundary of a surface: edges of a Tin with a triangle on one side only.
#pragma once

#include <cstdint>
#include <vector>

#include <itin/lattice_tin.hpp>
#include <itin/tin.hpp>

namespace itin::viewshed {

/// An edge of the boundary; the surface is to the left of from -> to.
struct BoundaryEdge {
  std::uint32_t from = 0;
  std::uint32_t to = 0;
  std::uint32_t triangle = 0;
};

/// Returns the edges in ascending order of their triangles. O(n) time, 6 bytes per triangle while running.
std::vector<BoundaryEdge> boundary_edges(const Tin& tin);

/// Gives the ends of each of these edges.
std::vector<RimEdge> rim_of(const Tin& tin, const std::vector<BoundaryEdge>& boundary);

/// Tells whether a sight line from a position on the surface can cross ground without data. It can where the surface
/// begins anew across some piece of its rim, seen from the position, less than `reach` metres away and within `lines`.
/// `lines` is a convex hull, metres, that holds the position and all sight lines.
bool surface_resumes(const Grid& units, const std::vector<RimEdge>& rim, Point2 position, double reach,
                     const std::vector<Point2>& lines);

}  // namespace itin::viewshed
