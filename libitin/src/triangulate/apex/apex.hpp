// Third vertices of constrained Delaunay triangles, straight from the quadtrees.
//
//   ApexSearch search(index, selection);
//   std::optional<SelectedVertex> c = search.apex(a, b);   // abc is a triangle of the global triangulation
//
// For a candidate c to the left of ab, with m the midpoint of ab, n the unit normal to the left and r = |ab| / 2, the
// circle through a, b, c has its centre at m + lambda n with
//     lambda(c) = (|c - m|^2 - r^2) / (2 n . (c - m)).
// The part of this circle on the left of ab grows with lambda. Leaves are visited in about the order of that bound and
// skipped when the best circle so far does not reach them. Skipping is conservative floating point; every decision is
// exact.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <itin/geometry.hpp>
#include <itin/tin.hpp>

#include "geometry/predicates.hpp"
#include "store/codec/point_index.hpp"
#include "triangulate/apex/block_reader.hpp"
#include "triangulate/apex/selection.hpp"

namespace itin {

struct ApexFrame;

/// A vertex as read from an index.
struct SelectedVertex {
  GridPoint point;
  std::uint16_t source = 0;
  std::uint8_t level = 0;
  std::uint16_t theme = 0;  ///< the theme within whose raised features it lies, off their outlines; 0: none

  Position position() const { return {point.x, point.y}; }
};

inline std::uint64_t code_of(const SelectedVertex& v) {
  return code_of(v.point);
}

/// Searches for third vertices. One search serves one thread and one region: it keeps and counts the blocks it has
/// read.
class ApexSearch {
 public:
  ApexSearch(const PointIndex& index, const Selection& selection)
      : index_(index), selection_(selection), blocks_(index) {}

  /// Makes intruder() and inside() pass over this box from now on: the caller has triangulated all selected vertices in
  /// it.
  void pass_over(const GridBox& known) { known_ = known; }

  /// Returns the third vertex of the triangle to the left of ab, an edge of the global triangulation that is no
  /// constraint; nullopt on the hull.
  std::optional<SelectedVertex> apex(Position a, Position b);
  /// Returns the vertex to the left of ab with the least circle, whatever segments come between; nullopt if there is
  /// none.
  std::optional<SelectedVertex> nearest_left_of(Position a, Position b);

  /// Returns a vertex to the left of ab, visible from both ends, inside the circle through a, b and c, where c lies to
  /// the right of ab: the vertex with the least circle, if there is any. (A vertex on the circle is decided by the tie
  /// rule.)
  std::optional<SelectedVertex> intruder(Position a, Position b, Position c);

  /// Returns the vertex in the closed triangle abc (counterclockwise) that is nearest to a box, other than its corners,
  /// if there is any.
  std::optional<SelectedVertex> inside(Position a, Position b, Position c, const GridBox& near);

  /// Returns the selected vertex at this very position.
  std::optional<SelectedVertex> at(Position p);

  const RetrievalStatistics& statistics() const { return blocks_.statistics(); }

 private:
  struct Search;
  enum class Segments { kHide, kPassed };
  void read_segments(const GridBox& part, Search& search);
  bool hidden(Position c, Search& search);
  bool hidden(const Leaf& leaf, Search& search);
  std::optional<SelectedVertex> left_of(Position a, Position b, Segments segments);
  std::optional<SelectedVertex> least_circle(const ApexFrame& frame, double lambda, const Position* beyond,
                                             const GridBox& known, Segments segments);
  std::optional<SelectedVertex> nearest_circle(const ApexFrame& frame, double lambda, const Position* beyond,
                                               const GridBox& known, Segments segments);
  std::vector<std::pair<double, const Leaf*>> leaves_from(const GridBox& place, const GridBox& box);
  void search_leaf(const Leaf& leaf, Search& search);

  const PointIndex& index_;
  const Selection& selection_;
  BlockReader blocks_;
  GridBox known_;
  // These are kept between calls for their memory.
  std::vector<Leaf> leaves_;
  std::vector<Segment> segments_;
};

/// Tells whether segment s properly crosses the line of sight pq: touching does not block it.
bool crosses(const Segment& s, Position p, Position q);

/// Tells whether the segments hide every position of the box from a or from b. One segment must hide each box, or each
/// of its parts an eighth as wide; the answer may be false where they do so only together. Never true otherwise.
bool hide(std::span<const Segment> segments, Position a, Position b, const GridBox& box);

}  // namespace itin
