// The ground that takes the place of raised features which a query leaves out.
//
// The triangles that have a top of these features for a corner are a region of the surface (opened_region.hpp). The
// tops go; its border stays, so that nothing changes outside of it. Where another feature adjoins, the tops beside it
// are lowered to the ground, as the feet of its wall. Within, the vertices of the terrain come back. The edges of the
// terrain's triangles that reach the region's border are constraints there, as far as they end at vertices: an import
// has put one wherever an outline crosses an edge of the full surface. Triangles farther in are the terrain's own, as
// no vertex on the border sees their corners.
//
// So the surface without features is a triangulation of selected vertices and segments, as any other is, and everything
// that holds for a store's triangulations (law 1) holds for it.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include <itin/geometry.hpp>
#include <itin/store.hpp>

#include "geometry/cell.hpp"
#include "geometry/predicates.hpp"
#include "store/codec/point_index.hpp"
#include "triangulate/apex/selection.hpp"
#include "triangulate/mesh/box_index.hpp"

namespace itin {

struct TopsOfTheme;

class GroundBeneath {
 public:
  /// Takes a selection with all features. Cost: two triangulations about the features. Throws CorruptStore, FileError,
  /// Cancelled.
  GroundBeneath(const Store& store, const Selection& selection, const std::vector<TopsOfTheme>& tops);

  /// Tells whether a vertex of a raised theme is a top that goes.
  bool removes(const GridPoint& p) const { return has_code(removed_, code_of(p)); }
  /// Returns the height of the ground, grid units, where a vertex of a raised theme is a top that is lowered to it.
  std::optional<std::int32_t> lowered(const GridPoint& p) const { return lowered(code_of(p)); }
  /// Tells whether a segment ends at a top of either kind. Those that stay are among segments().
  bool removes(const Segment& s) const { return is_top(code_of(s.a())) || is_top(code_of(s.b())); }
  /// Tells whether a vertex of the terrain, which made way, is there again.
  bool restores(const GridPoint& p) const { return has_code(restored_, code_of(p)); }
  /// Appends the constraints in the place of the features that meet the box.
  void segments(const GridBox& box, std::vector<Segment>& out) const;

 private:
  std::optional<std::int32_t> lowered(std::uint64_t code) const;
  bool is_top(std::uint64_t code) const { return has_code(removed_, code) || lowered(code); }

  std::vector<std::uint64_t> removed_, restored_;                ///< ascending
  std::vector<std::pair<std::uint64_t, std::int32_t>> lowered_;  ///< codes and heights, ascending
  std::vector<Segment> segments_;
  BoxIndex segments_near_;
};

}  // namespace itin
