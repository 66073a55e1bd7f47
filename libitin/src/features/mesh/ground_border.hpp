// The border of the ground that raised features change: edges of the full surface that no feature of their theme cuts.
// While no other theme is present nothing may cut these edges, or the triangles beyond would change. Where another
// theme's lines cross such an edge, the edge is left out when that theme is present.
//
//   GroundBorder border(themes);
//   border.add(theme, changed);                     // what each piece of each theme changes
//   lines = ...; + border.seams()                   // planar, with all other lines
//   auto fit = border.fit(lines, ...);              // while it has lines: planar again, with these
//   fit.placed                                      // in the end
//
// Making lines planar leads them past vertices of other themes, less than a grid step aside, and so now and then onto a
// border or over it. Then the triangle beyond is changed ground as well, and the border moves on, around it.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <set>
#include <vector>

#include "features/plan/plan_overlay.hpp"
#include "features/plan/planar.hpp"

namespace itin {

/// Triangles of the full surface that raised features change, by their edges.
struct ChangedGround {
  std::vector<GridEdge> pieces;  ///< what features' lines leave of the edges between them, rounded to the grid
  std::vector<GridEdge> inner;   ///< whole edges between them or under roofs, the lesser end first
  std::vector<GridEdge> border;  ///< edges with such a triangle to the left and none to the right

  void append(const ChangedGround& other);
};

struct BorderEdge {
  std::uint32_t theme = 0;  ///< from 0
  GridEdge edge;            ///< its lesser end first
  friend auto operator<=>(const BorderEdge&, const BorderEdge&) = default;
};

/// The owner of a line and, where the owner stands on the ground, the line's cluster.
struct LineOwner {
  std::uint32_t owner = 0;
  std::uint32_t cluster = kNoFeature;
  friend auto operator<=>(const LineOwner&, const LineOwner&) = default;
};

struct PlacedBorder {
  BorderEdge border;
  std::vector<LineOwner> makes_way_for;  ///< ascending
};

class GroundBorder {
 public:
  /// The owners of lines.
  struct Owners {
    std::vector<std::uint32_t> theme;  ///< by owner; those after the themes stand on the ground
    std::vector<bool> terrain;         ///< by theme: whether it is part of the full surface
  };
  /// Finds the full surface's third vertex left of an edge of it; nothing at the end of the ground.
  using Apex = std::function<std::optional<Position>(Position from, Position to)>;

  explicit GroundBorder(std::size_t themes) : themes_(themes) {}
  void add(std::uint32_t theme, const ChangedGround& changed);

  /// Returns the edges where the changed ground of two pieces of a theme meets, to be kept as lines, owned by themes.
  std::vector<OwnedSegment> seams();
  struct Fit {
    std::vector<OwnedSegment> lines;   ///< edges to keep where their own theme's lines cut the border, which moved on
    std::vector<PlacedBorder> placed;  ///< if there are none: the borders still needed; a line of the terrain or
                                       ///< of their own theme makes them needless
  };
  Fit fit(const PlanarLines& lines, const Owners& owners, const Apex& apex);

 private:
  struct OfTheme {
    std::set<GridEdge> inner, border;
  };
  class Contacts;
  OwnedSegment keep(std::uint32_t theme, const GridEdge& edge);
  std::vector<OwnedSegment> widen(const Contacts& contacts, const Owners& owners, const Apex& apex);
  std::vector<PlacedBorder> place(const Contacts& contacts, const Owners& owners) const;

  std::vector<OfTheme> themes_;
};

}  // namespace itin
