// The edges that constraint segments are made of in a triangulation.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "triangulate/apex.hpp"
#include "triangulate/delaunay.hpp"

namespace itin {

/// An edge of the mesh along a segment, in its direction; kNoTriangle beyond the hull.
struct SegmentEdge {
  std::uint32_t from, to;
  std::uint32_t left, right;
  std::uint16_t theme = kCoverage;
};

/// Finds the edges of every segment, given by its ends and its theme, and marks them in the mesh as constrained.
/// Nothing when some segment is not made of edges. The mesh must be that of a whole triangulation, up to its convex
/// hull.
std::optional<std::vector<SegmentEdge>> lay_segments(PlaneMesh& mesh, std::span<const SelectedVertex> vertices,
                                                     std::span<const Delaunay::Constraint> segments,
                                                     std::span<const std::uint16_t> themes);

}  // namespace itin
