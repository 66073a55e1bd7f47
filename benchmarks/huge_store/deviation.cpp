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

/// The surface of every 2^steps-th post, at all of them; times 2^steps, so that there are no fractions.
Posts coarse_heights(const Posts& heights, int steps) {
  Posts coarse(heights.box().coarser(steps));
  const PostBox& box = coarse.box();
  for (std::int32_t row = box.rows.first; row <= box.rows.last; ++row) {
    for (std::int32_t column = box.columns.first; column <= box.columns.last; ++column)
      *coarse.at(column, row) = *heights.at(column << steps, row << steps);
  }
  while (steps-- > 0) {
    coarse = refined(
        coarse, heights.box().coarser(steps), [](std::int32_t z) { return 2 * z; },
        [](std::int32_t a, std::int32_t b, std::int32_t, std::int32_t) { return a + b; });
  }
  return coarse;
}

/// Of heights - coarse / 2^steps over the box, rounded outwards to grid units.
HeightBounds extremes(const Posts& heights, const Posts& coarse, int steps, const PostBox& box) {
  std::int32_t lo = 0, hi = 0;
  const auto width = static_cast<std::size_t>(box.columns.count());
  for (std::int32_t row = box.rows.first; row <= box.rows.last; ++row) {
    const std::int32_t* fine = heights.at(box.columns.first, row);
    const std::int32_t* below = coarse.at(box.columns.first, row);
    for (std::size_t i = 0; i < width; ++i) {
      const std::int32_t difference = (fine[i] << steps) - below[i];
      lo = std::min(lo, difference), hi = std::max(hi, difference);
    }
  }
  return {(lo * Square::kUnitsADecimetre) >> steps, -((-hi * Square::kUnitsADecimetre) >> steps)};
}

}  // namespace

Deviation::Deviation(const Square& square)
    : square_(square),
      first_column_(patch_of(square.ground().xmin)),
      first_row_(patch_of(square.ground().ymin)),
      columns_(static_cast<std::size_t>(patch_of(square.ground().xmax) - first_column_ + 1)),
      sums_(columns_ * static_cast<std::size_t>(patch_of(square.ground().ymax) - first_row_ + 1)) {}

template <class Deviations, class Visit>
void Deviation::for_each_patch(Deviations& deviations, const Cell& cell, const Visit& visit) {
  if (cell.log2_side < kPatchLog2Side) throw std::logic_error("a cell is smaller than a patch");
  const GridBox box = intersection(cell.box(), deviations.square_.ground());
  for (std::int32_t row = patch_of(box.ymin); row <= patch_of(box.ymax); ++row) {
    for (std::int32_t column = patch_of(box.xmin); column <= patch_of(box.xmax); ++column) {
      visit(patch_at(column, row),
            deviations.sums_[static_cast<std::size_t>(row - deviations.first_row_) * deviations.columns_ +
                             static_cast<std::size_t>(column - deviations.first_column_)]);
    }
  }
}

void Deviation::add(const Cell& cell, int stage, int steps, const Posts& heights) {
  const Posts coarse = coarse_heights(heights, steps);
  for_each_patch(*this, cell, [&](const Cell& patch, HeightBounds& sum) {
    const HeightBounds more = extremes(heights, coarse, steps, square_.about(patch, stage));
    sum.lo += more.lo, sum.hi += more.hi;
  });
}

HeightBounds Deviation::over(const Cell& cell) const {
  HeightBounds widest;
  for_each_patch(*this, cell, [&](const Cell&, const HeightBounds& sum) {
    widest.lo = std::min(widest.lo, sum.lo), widest.hi = std::max(widest.hi, sum.hi);
  });
  return widest;
}

}  // namespace itin::huge
