// The ground whose points and segments a region's triangulation has completely: a box, and cells that were read later.
#pragma once

#include <cstdint>
#include <unordered_set>
#include <vector>

#include <itin/geometry.hpp>

#include "geometry/cell.hpp"

namespace itin {

class KnownGround {
 public:
  KnownGround() = default;
  KnownGround(const GridBox& box, int log2_cell_side) : box_(box), log2_side_(log2_cell_side) {}

  bool covers(const GridBox& b) const {
    return b.empty() || box_.contains(b) || visit(b, [](const Cell&) { return false; });
  }
  /// Adds the unknown cells that b meets. Returns false, with nothing added, where b meets too many cells.
  bool add_missing(const GridBox& b, std::vector<Cell>& missing) const {
    return visit(b, [&](const Cell& cell) {
      missing.push_back(cell);
      return true;
    });
  }
  void add(const Cell& cell) { cells_.insert(cell.code); }
  double cell_side() const { return static_cast<double>(std::int64_t{1} << log2_side_); }

 private:
  static constexpr std::int64_t kMostCells = 1024;

  /// Calls unknown(cell) for the cells that b meets and that are not known. Returns false where b meets too many cells,
  /// or where unknown() does.
  template <class Unknown>
  bool visit(const GridBox& b, const Unknown& unknown) const {
    const std::int64_t half = kGridHalfSide, x0 = (b.xmin + half) >> log2_side_, x1 = (b.xmax + half) >> log2_side_,
                       y0 = (b.ymin + half) >> log2_side_, y1 = (b.ymax + half) >> log2_side_;
    if ((x1 - x0 + 1) * (y1 - y0 + 1) > kMostCells) return false;
    for (std::int64_t y = y0; y <= y1; ++y) {
      for (std::int64_t x = x0; x <= x1; ++x) {
        const Cell cell{morton(static_cast<std::int32_t>((x << log2_side_) - half),
                               static_cast<std::int32_t>((y << log2_side_) - half)),
                        log2_side_};
        if (cells_.contains(cell.code)) continue;
        if (!box_.contains(intersection(b, cell.box())) && !unknown(cell)) return false;
      }
    }
    return true;
  }

  GridBox box_;
  int log2_side_ = 0;
  std::unordered_set<std::uint64_t> cells_;  ///< codes
};

}  // namespace itin
