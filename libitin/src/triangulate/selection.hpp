// Which stored vertices a Detail selects: a predicate of the vertex alone, never of the window, so that the
// triangulation of the selected vertices is one and the same whatever part of it is asked for.
#pragma once

#include <cstdint>
#include <vector>

#include <itin/detail.hpp>
#include <itin/geometry.hpp>

namespace itin {

/// A tolerance T asks for the coarsest level whose tolerance is at most T. The centre and the radii of rings are
/// rounded to the grid; a vertex belongs to the first ring whose circle contains it or has it on its rim, decided in
/// integers.
class Selection {
 public:
  /// `tolerances` of the levels in metres, ascending, level 0 (tolerance 0) first.
  Selection(const Detail& detail, const std::vector<double>& tolerances, const Grid& grid);

  /// The levels asked for at the centre and beyond the last ring.
  int finest() const { return finest_; }
  int coarsest() const { return coarsest_; }
  /// The least level that may be selected in `box` (not empty).
  int finest_in(const GridBox& box) const;
  /// Whether a vertex of this level is part of the surface: its level is at least the one asked for at (x, y).
  bool selects(int level, std::int32_t x, std::int32_t y) const {
    if (level >= coarsest_) return true;
    return level >= finest_ && level >= level_at(x, y);
  }

 private:
  struct Disc {
    std::int64_t radius;  ///< grid units
    int level;
  };

  int level_at(std::int64_t x, std::int64_t y) const;

  int finest_ = 0;
  int coarsest_ = 0;
  std::int64_t x_ = 0;
  std::int64_t y_ = 0;
  std::vector<Disc> discs_;  ///< all rings but the last, which has no end
};

}  // namespace itin
