// The line generalisation tree (C. B. Jones and I. M. Abraham, Design considerations for a scale-independent
// cartographic database, 1986): every vertex of a line has the coarsest level at which the line needs it, and a line at
// level k consists of its vertices of level k and coarser, in their order along it.
//
//   LineHierarchy lines(segments, nodes, height, tolerances);
//   for (const Segment& s : lines.segments()) ...       // all levels, with finest, coarsest and reach
//
// Lines are cut into chains at their junctions, where themes change and at `nodes`; closed chains at three extremes.
// These vertices stay at every level. A shortcut may take the place of a piece of a chain where the piece's vertices
// lie within the level's tolerances of it, where it does not cross the piece, and where no other vertex of any line
// lies in the closed region between both (D. H. Douglas and T. K. Peucker, 1973, choose the pieces). So a shortcut
// crosses no other line and no other line's shortcut, of whatever levels: what crosses it would have to end in that
// region.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include <itin/geometry.hpp>

#include "geometry/predicates.hpp"
#include "store/segment_features.hpp"

namespace itin {

/// By level, level 0 first, in grid units.
struct LineTolerance {
  double vertical = 0;
  double lateral = 0;
};

class LineHierarchy {
 public:
  using HeightAt = std::function<std::int32_t(Position)>;

  /// `segments` must be planar, of themes; those of `whole` themes are not generalised. `nodes`: further vertices to
  /// keep at every level, and to keep away from.
  LineHierarchy(const std::vector<Segment>& segments, const std::vector<Segment>& whole,
                const std::vector<std::uint64_t>& nodes, const HeightAt& height,
                const std::vector<LineTolerance>& tolerances);

  /// The segments of all levels, ascending; without those of `whole`.
  std::vector<Segment> segments() const;
  /// Which features the segments of all levels are of, ascending; `of_whole` tells it of the segments that it was made
  /// of. Precondition: `nodes` has all vertices where a theme's line goes on as another feature's.
  std::vector<SegmentFeature> features(const std::vector<SegmentFeature>& of_whole) const;

  struct VertexLevel {
    std::uint64_t code;
    std::uint8_t level;
    friend auto operator<=>(const VertexLevel&, const VertexLevel&) = default;
  };
  /// The coarsest level that needs each vertex, ascending by code; without those of `whole` alone.
  std::vector<VertexLevel> levels() const;

  /// An edge of a line at a level, between these vertices, the lesser first; where they are one, the edge that stands
  /// for this vertex.
  struct Shortcut {
    int level;
    Position a, b;
    friend auto operator<=>(const Shortcut&, const Shortcut&) = default;
  };
  /// Vertices that are part of their line at the levels from `finest` to `coarsest` as well now, and their box.
  struct Restored {
    GridBox box;
    int finest, coarsest;
  };
  /// Puts the vertices that these shortcuts (ascending) stand for back into their levels and all finer ones. What is no
  /// shortcut at its level is passed over.
  std::vector<Restored> restore(const std::vector<Shortcut>& shortcuts);

 private:
  struct Chain {
    std::vector<Position> vertices;
    std::vector<std::int32_t> heights;
    std::vector<std::uint8_t> levels;
    std::vector<std::uint16_t> themes;
  };
  class Graph;

  void simplify(Chain& chain, const std::vector<LineTolerance>& tolerances) const;
  void choose(Chain& chain, std::size_t from, std::size_t to, int level, const LineTolerance& tolerance) const;
  bool may_replace(const Chain& chain, std::size_t from, std::size_t to) const;
  template <class Visit>
  void for_each_edge(const Chain& chain, const Visit& visit) const;
  template <class Visit>
  void for_each_segment(const Chain& chain, const Visit& visit) const;

  int coarsest_ = 0;
  std::vector<Chain> chains_;
  std::vector<std::uint64_t> obstacles_;  ///< vertices of all lines, ascending
};

}  // namespace itin
