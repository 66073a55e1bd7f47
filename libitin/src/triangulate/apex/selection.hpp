// The stored vertices and segments that a Detail and a choice of themes select. This is a predicate of the item alone,
// never of the window, so that the triangulation of the selected items is the same whatever part of it is asked for.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <itin/detail.hpp>
#include <itin/geometry.hpp>
#include <itin/store.hpp>
#include <itin/theme.hpp>

#include "store/codec/point_index.hpp"

namespace itin {

/// Selects vertices and segments. A tolerance T asks for the coarsest level whose tolerance is at most T. The centre
/// and the radii of rings are rounded to the grid. A vertex belongs to the first ring whose circle contains it or has
/// it on its rim, decided in integers.
class Selection {
 public:
  /// Takes the `tolerances` of the levels in metres, ascending, level 0 (tolerance 0) first.
  Selection(const Detail& detail, const std::vector<double>& tolerances, const Grid& grid);

  /// Leaves out a theme, by its number, or the coverage outline. At first all are selected.
  void leave_out(std::uint16_t theme);
  bool includes(std::uint16_t theme) const { return theme >= left_out_.size() || !left_out_[theme]; }

  /// Leaves out the features that these are the tops of; null: none.
  void omit(std::shared_ptr<const OmittedTops> tops) { omitted_ = std::move(tops); }
  const std::shared_ptr<const OmittedTops>& omitted() const { return omitted_; }
  /// Returns what is selected with every feature of the chosen themes.
  Selection with_all_features() const;
  /// Returns what is selected of the terrain, of lines on it, and of all features of this raised theme; 0: of none.
  Selection with_raised_alone(const StoreMetadata& metadata, std::uint16_t theme) const;

  /// These are the levels asked for at the centre and beyond the last ring.
  int finest() const { return finest_; }
  int coarsest() const { return coarsest_; }
  /// Returns the least level that is asked for in `box` (not empty).
  int finest_in(const GridBox& box) const;
  /// Returns the levels that are asked for in `box` (not empty).
  LevelRange levels_in(const GridBox& box) const;
  /// Tells whether a vertex of this level is part of the surface: its level is at least the one asked for at (x, y).
  bool selects(int level, std::int32_t x, std::int32_t y) const {
    if (level >= coarsest_) return true;
    return level >= finest_ && level >= level_at(x, y);
  }
  /// Tells whether a leaf's vertex of this level is part of the surface, and the leaf is the one to take it from.
  bool selects(const Leaf& leaf, int level, std::int32_t x, std::int32_t y) const {
    if (leaf.serves.finest <= finest_ && coarsest_ <= leaf.serves.coarsest) return selects(level, x, y);
    const int asked = level_at(x, y);
    return level >= asked && leaf.serves.finest <= asked && asked <= leaf.serves.coarsest;
  }
  /// Tells whether a segment is a constraint: its theme is chosen, and it is part of its line at every level asked for
  /// about it. Where a line leaves one ring for the next, no segment may be a constraint; elsewhere the line's segments
  /// are unaffected.
  bool selects(const Segment& segment) const;

  friend bool operator==(const Selection&, const Selection&) = default;

 private:
  struct Disc {
    std::int64_t radius;  ///< grid units
    int level;
    friend bool operator==(const Disc&, const Disc&) = default;
  };

  int level_at(std::int64_t x, std::int64_t y) const;

  int finest_ = 0;
  int coarsest_ = 0;
  std::int64_t x_ = 0;
  std::int64_t y_ = 0;
  std::vector<Disc> discs_;     ///< all rings but the last, which has no end
  std::vector<bool> left_out_;  ///< by theme
  std::shared_ptr<const OmittedTops> omitted_;
};

/// Returns the selection of a query of a store. Throws InputError for a theme that the store does not have.
Selection selection_of(const StoreMetadata& metadata, const Detail& detail, const ThemeChoice& themes);

/// Appends the leaves of an index that may hold something selected in `box`, without those whose levels no place of
/// theirs asks for.
void selected_leaves(const PointIndex& index, const Selection& selection, const GridBox& box, std::vector<Leaf>& out);

}  // namespace itin
