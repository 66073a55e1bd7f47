// Where there is ground: the union of those triangles of the plain Delaunay triangulation of all points whose edges do
// not exceed the gaps of their sources (SourceInfo::gap_basis). Its outline, voids included, becomes the built-in
// constraint theme, so that nothing is ever triangulated into ground across a hole, at any level.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <itin/progress.hpp>

#include "pyramid/working_index.hpp"

namespace itin {

struct Coverage {
  /// Ground to the left; ends at the outline's corners, so pieces in line are one segment. No two cross.
  std::vector<Segment> outline;
  /// Points of no ground triangle, as Morton codes.
  std::vector<std::uint64_t> isolated;
};

/// `gap_bases` per source, grid units. The index must have no segments yet.
Coverage find_coverage(const WorkingIndex& index, const std::vector<CurveRange>& tiles,
                       const std::vector<std::array<double, 4>>& gap_bases, Progress& progress);

/// One segment for each maximal straight run of the directed edges, in a canonical order.
std::vector<Segment> join_collinear(std::vector<Segment> edges);

}  // namespace itin
