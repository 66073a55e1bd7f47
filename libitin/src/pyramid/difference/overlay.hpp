// Computes the difference between the full surface and a coarse one, exactly where its extremes lie.
//
// T0 - Tk is linear on every face of the overlay of both triangulations. The overlay's vertices are T0's vertices and
// the crossings of T0's edges with Tk's (Tk's vertices are T0's as well). So the extremes over a triangle of T0 lie on
// its edges, at their ends and crossings (law 2).
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <itin/bucket_lists.hpp>

#include "pyramid/difference/failures.hpp"
#include "triangulate/region/region.hpp"

namespace itin {

/// A range of differences in grid units, rounded outwards; empty at first.
struct DifferenceRange {
  std::int32_t lo = std::numeric_limits<std::int32_t>::max();
  std::int32_t hi = std::numeric_limits<std::int32_t>::min();

  bool empty() const { return lo > hi; }
  /// The larger of both sides, as a distance.
  std::int32_t size() const { return empty() ? 0 : std::max(-lo, hi); }
  void add(const DifferenceRange& r) { lo = std::min(lo, r.lo), hi = std::max(hi, r.hi); }
};

/// The edges of a fine mesh, each once, and the edges at each vertex.
class FineEdges {
 public:
  struct Edge {
    std::uint32_t u, v;
    std::uint32_t triangle, other;  ///< the triangles at it; kNoTriangle where there is none
  };
  explicit FineEdges(const RegionMesh& fine);

  const std::vector<Edge>& edges() const { return edges_; }
  /// The numbers of the edges at a vertex.
  std::span<const std::uint32_t> at_vertex(std::uint32_t v) const { return at_vertex_.in(v); }

 private:
  std::vector<Edge> edges_;
  BucketLists at_vertex_;
};

struct Difference {
  std::vector<DifferenceRange> along_edge;  ///< over each fine edge
  Failures failures;
};

/// Measures the difference. The coarse mesh's vertices must be among the full surface's, and it must cover every vertex
/// of the fine mesh. A difference greater than `allowed` at a vertex or a crossing is a failure.
Difference difference(const RegionMesh& fine, const FineEdges& edges, const RegionMesh& coarse, std::int32_t allowed);

/// The difference over each fine triangle.
std::vector<DifferenceRange> over_triangles(const RegionMesh& fine, const FineEdges& edges,
                                            const Difference& difference);

}  // namespace itin
