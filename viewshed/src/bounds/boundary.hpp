// Where the surface ends: edges of a Tin with a triangle on one side only.
#pragma once

#include <cstdint>
#include <vector>

#include <itin/lattice_tin.hpp>
#include <itin/tin.hpp>

namespace itin::viewshed {

/// The surface is to the left of from -> to.
struct BoundaryEdge {
  std::uint32_t from = 0;
  std::uint32_t to = 0;
  std::uint32_t triangle = 0;
};

/// In ascending order of the triangles they belong to. O(n) time, 6 bytes per triangle while running.
std::vector<BoundaryEdge> boundary_edges(const Tin& tin);

/// Gives the ends of each of these edges.
std::vector<RimEdge> rim_of(const Tin& tin, const std::vector<BoundaryEdge>& boundary);

/// Whether a sight line from a position on the surface can cross ground without data: whether the surface begins anew
/// across some piece of its rim, seen from there, less than `reach` metres away and within `lines`: a convex hull,
/// metres, that holds the position and all sight lines.
bool surface_resumes(const Grid& units, const std::vector<RimEdge>& rim, Point2 position, double reach,
                     const std::vector<Point2>& lines);

}  // namespace itin::viewshed
