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
// crosses no other line, and no other line's shortcut at any level: whatever crossed it would have to end in that
// region.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include <itin/geometry.hpp>

#include "geometry/predicates.hpp"
#include "store/segments/segment_features.hpp"

namespace itin {

/// The tolerances of a level's lines, in grid units; lists of them hold level 0 first.
struct LineTolerance {
  double vertical = 0;
  double lateral = 0;
};

class LineHierarchy {
 public:
  using HeightAt = std::function<std::int32_t(Position)>;

  /// `segments`, the lines of themes, must be planar. `whole`: segments of themes that are not generalised. `nodes`:
  /// further vertices to keep at every level, and to keep away from.
  LineHierarchy(const std::vector<Segment>& segments, const std::vector<Segment>& whole,
                const std::vector<std::uint64_t>& nodes, const HeightAt& height,
                const std::vector<LineTolerance>& tolerances);

  /// The segments of all levels, ascending, without `whole`.
  std::vector<Segment> segments() const;
  /// Returns the features that the segments of all levels are part of, ascending. `of_whole` tells the features of the
  /// segments given to the constructor. Precondition: `nodes` has all vertices where a theme's line goes on as another
  /// feature's.
  std::vector<SegmentFeature> features(const std::vector<SegmentFeature>& of_whole) const;

  struct VertexLevel {
    std::uint64_t code;
    std::uint8_t level;
    friend auto operator<=>(const VertexLevel&, const VertexLevel&) = default;
  };
  /// The coarsest level that needs each vertex, ascending by code, without vertices of `whole` alone.
  std::vector<VertexLevel> levels() const;

  /// An edge of a line at a level, between these vertices, the lesser first. Where both are one vertex, the edge that
  /// leaves this vertex out.
  struct Shortcut {
    int level;
    Position a, b;
    friend auto operator<=>(const Shortcut&, const Shortcut&) = default;
  };
  /// Vertices that are now part of their line at the levels from `finest` to `coarsest` too, and their box.
  struct Restored {
    GridBox box;
    int finest, coarsest;
  };
  /// Puts the vertices that these shortcuts (ascending) leave out back into the shortcuts' levels and all finer ones.
  /// An edge that is no shortcut at its level is passed over.
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
