// The interface to a set of points that triangulation needs: the leaves that meet a box, and their points.
//
// Store implements it on disk; the importer implements it on its sorted temporary file, so that one triangulation
// serves both.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <memory>
#include <optional>
#include <vector>

#include <itin/geometry.hpp>

#include "geometry/cell.hpp"
#include "geometry/post_lattice.hpp"
#include "store/codec/point_sources.hpp"

namespace itin {

/// A range of levels, both ends included.
struct LevelRange {
  int finest = 0, coarsest = 0;
};

/// A leaf of a point quadtree. `level` is the coarsest that any of its points may have: that of all of them where
/// Block::levels is empty. In the importer's tree, `points` counts the points that were asked for.
struct Leaf {
  Cell cell;
  int level = 0;
  std::uint32_t points = 0;
  std::int32_t zmin = 0;  ///< grid units
  std::int32_t zmax = 0;
  std::int32_t lo = 0;  ///< T_level + lo <= T_0 <= T_level + hi over the cell, grid units
  std::int32_t hi = 0;
  std::uint64_t key = 0;    ///< the index's own key, different for each leaf
  std::uint16_t theme = 0;  ///< the theme of the vertices, 0 for terrain; a theme's vertices are present at every level
  LevelRange serves{0, 0xff};  ///< the leaf has what is there where one of these levels is asked for; elsewhere, other
                               ///< leaves have the same points
  std::uint32_t asked = 0;     ///< about how many points have a level that was asked for
};

/// A leaf's points.
struct Block {
  std::vector<GridPoint> points;  ///< in ascending Morton order where in_order is true
  bool in_order = true;           ///< false: points may be in any order, and `sources` do not correspond to them one by
                                  ///< one
  PointSources sources;
  std::vector<std::uint8_t> levels;   ///< per point, or empty when all points have the leaf's level
  std::uint16_t raised_theme = 0;     ///< the theme whose features the points belong to; 0 unless they are a raised
                                      ///< theme's
  std::vector<std::uint8_t> outline;  ///< per point of raised_theme: whether it lies between a feature and the ground

  /// Returns the theme within whose features the point lies, off their outlines; 0 for none.
  std::uint16_t theme(std::size_t k) const {
    return static_cast<std::uint16_t>(raised_theme != 0 && outline[k] == 0 ? raised_theme : 0);
  }
  /// Returns the memory that the block takes.
  std::size_t bytes() const {
    return sizeof(Block) + points.size() * sizeof(GridPoint) + sources.bytes() + levels.size() + outline.size();
  }
};

/// The heights of a leaf whose points have all places of their lattice.
struct PostHeights {
  PostLattice lattice;
  std::uint32_t columns = 0, rows = 0;
  std::vector<std::int32_t> heights;  ///< grid units, row by row from the lattice's first place
};

/// Returns the level of a leaf's point k.
inline std::uint8_t level_of(const Leaf& leaf, const Block& block, std::size_t k) {
  return block.levels.empty() ? static_cast<std::uint8_t>(leaf.level) : block.levels[k];
}

/// The built-in theme of the coverage outline; other themes are numbered from 1.
inline constexpr std::uint16_t kCoverage = 0;

/// A piece of a constraint line; its ends are on vertices that are present at all of its levels. A coverage segment has
/// ground to its left. Vertices of any level may lie on it, and split it where they are selected. It crosses no segment
/// that may be selected together with it.
struct Segment {
  std::int32_t ax = 0, ay = 0;
  std::int32_t bx = 0, by = 0;
  std::uint16_t theme = kCoverage;
  std::uint8_t finest = 0, coarsest = 0xff;  ///< levels at which the segment is part of its line
  std::int32_t reach = 0;  ///< finer segments that it replaces lie within its box, widened by this on all sides

  Position a() const { return {ax, ay}; }
  Position b() const { return {bx, by}; }
  std::array<Position, 2> ends() const { return {a(), b()}; }
  friend auto operator<=>(const Segment&, const Segment&) = default;
};

inline GridBox extent_of(const Segment& s) {
  return {std::min(s.ax, s.bx), std::min(s.ay, s.by), std::max(s.ax, s.bx), std::max(s.ay, s.by)};
}

/// Read access to a set of points and segments. Safe for concurrent use.
class PointIndex {
 public:
  virtual ~PointIndex() = default;

  virtual int level_count() const = 0;
  /// The box of all points.
  virtual GridBox bounds() const = 0;

  /// Appends every non-empty leaf, of all themes, that meets `box` and has points where a level of `asked` is asked
  /// for, each leaf once.
  virtual void leaves(const LevelRange& asked, const GridBox& box, std::vector<Leaf>& out) const = 0;
  virtual std::shared_ptr<const Block> block(const Leaf& leaf) const = 0;
  /// Returns what block() does, its points in any order.
  virtual std::shared_ptr<const Block> unordered_block(const Leaf& leaf) const { return block(leaf); }
  /// Returns what unordered_block() does, for callers who will not ask again: it need not be cached.
  virtual std::shared_ptr<const Block> block_once(const Leaf& leaf) const { return unordered_block(leaf); }
  /// Returns what block_once() does, for callers who use only the positions in plan: the heights may be anything.
  virtual std::shared_ptr<const Block> plan_once(const Leaf& leaf) const { return block_once(leaf); }

  /// Returns a lattice that has all of the leaf's points. An index that has recorded one does not read them.
  virtual PostLattice lattice_of(const Leaf& leaf) const;
  /// Returns the heights of a leaf whose points have all places of their lattice, where the index keeps them so.
  virtual std::optional<PostHeights> posts_once(const Leaf&) const { return std::nullopt; }

  /// Appends every segment that meets `box`, of the coverage and of all themes, at all levels, and perhaps others
  /// nearby. A segment may come twice.
  virtual void segments(const GridBox& box, std::vector<Segment>& out) const = 0;
  /// Appends those of segments() that are of the coverage. An index that keeps them apart does not read the others.
  virtual void outline(const GridBox& box, std::vector<Segment>& out) const;
};

inline void PointIndex::outline(const GridBox& box, std::vector<Segment>& out) const {
  std::vector<Segment> all;
  segments(box, all);
  std::copy_if(all.begin(), all.end(), std::back_inserter(out), [](const Segment& s) { return s.theme == kCoverage; });
}

inline PostLattice PointIndex::lattice_of(const Leaf& leaf) const {
  WidestLattice widest;
  const auto block = unordered_block(leaf);
  for (const GridPoint& p : block->points) widest.add(p.x, p.y);
  return widest.lattice();
}

}  // namespace itin
