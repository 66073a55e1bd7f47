#include "huge_store/deviation.hpp"

#include <algorithm>
#include <stdexcept>

namespace itin::huge {

namespace {

/// The number of a coordinate's column or row of patches.
std::int32_t patch_of(std::int32_t coordinate) {
  return (coordinate + kGridHalfSide) >> Deviation::kPatchLog2Side;
}

Cell patch_at(std::int32_t column, std::int32_t row) {
  const auto corner = [](std::int32_t number) { return (number << Deviation::kPatchLog2Side) - kGridHalfSide; };
  return {morton(corner(column), corner(row)), Deviation::kPatchLog2Side};
}

/// The surface of a coarser stage at all posts about a box of stage 0; times 2^stage, so that there are no fractions.
Posts scaled_surface(const Fractal& fractal, int stage, const PostBox& box) {
  Posts surface = fractal.heights(stage, box.coarser(stage));
  while (stage-- > 0) {
    surface = refined(
        surface, box.coarser(stage), [](std::int32_t z) { return 2 * z; },
        [](std::int32_t a, std::int32_t b, std::int32_t, std::int32_t) { return a + b; });
  }
  return surface;
}

/// The extremes of heights - scaled / 2^stage over the box, rounded outwards to grid units.
HeightBounds extremes(const Posts& heights, const Posts& scaled, int stage, const PostBox& box) {
  std::int32_t lo = 0, hi = 0;
  const auto width = static_cast<std::size_t>(box.columns.count());
  for (std::int32_t row = box.rows.first; row <= box.rows.last; ++row) {
    const std::int32_t* fine = heights.at(box.columns.first, row);
    const std::int32_t* below = scaled.at(box.columns.first, row);
    for (std::size_t i = 0; i < width; ++i) {
      const std::int32_t difference = (fine[i] << stage) - below[i];
      lo = std::min(lo, difference), hi = std::max(hi, difference);
    }
  }
  return {(lo * Square::kUnitsPerDecimetre) >> stage, -((-hi * Square::kUnitsPerDecimetre) >> stage)};
}

}  // namespace

Deviation::Deviation(const Square& square, const Fractal& fractal, const std::vector<FractalLevel>& levels)
    : square_(square),
      fractal_(fractal),
      levels_(levels),
      first_column_(patch_of(square.ground().xmin)),
      first_row_(patch_of(square.ground().ymin)),
      columns_(static_cast<std::size_t>(patch_of(square.ground().xmax) - first_column_ + 1)) {
  const auto rows = static_cast<std::size_t>(patch_of(square.ground().ymax) - first_row_ + 1);
  bounds_.assign(levels.size(), std::vector<HeightBounds>(columns_ * rows));
}

template <class Visit>
void Deviation::for_each_patch(const Cell& cell, const Visit& visit) const {
  if (cell.log2_side < kPatchLog2Side) throw std::logic_error("a cell is smaller than a patch");
  const GridBox box = intersection(cell.box(), square_.ground());
  for (std::int32_t row = patch_of(box.ymin); row <= patch_of(box.ymax); ++row) {
    for (std::int32_t column = patch_of(box.xmin); column <= patch_of(box.xmax); ++column)
      visit(patch_at(column, row),
            static_cast<std::size_t>(row - first_row_) * columns_ + static_cast<std::size_t>(column - first_column_));
  }
}

void Deviation::find(const Cell& cell, const Posts& heights) {
  for (std::size_t k = 1; k < levels_.size(); ++k) {
    const int stage = levels_[k].stage;
    const Posts scaled = scaled_surface(fractal_, stage, heights.box());
    for_each_patch(cell, [&](const Cell& patch, std::size_t number) {
      bounds_[k][number] = extremes(heights, scaled, stage, square_.about(patch, 0));
    });
  }
}

HeightBounds Deviation::over(const Cell& cell, int level) const {
  HeightBounds widest;
  if (level == 0) return widest;
  for_each_patch(cell, [&](const Cell&, std::size_t number) {
    const HeightBounds& bounds = bounds_[static_cast<std::size_t>(level)][number];
    widest.lo = std::min(widest.lo, bounds.lo), widest.hi = std::max(widest.hi, bounds.hi);
  });
  return widest;
}

}  // namespace itin::huge
