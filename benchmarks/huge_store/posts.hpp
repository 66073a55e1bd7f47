// Part of a square lattice of posts, which may be refined: at half the spacing, a new post lies in the middle of an
// edge of the coarser lattice's triangulation, whose cells all have falling diagonals (itin/lattice_tin.hpp). So the
// finer triangulation divides the coarser one's triangles, and no edge of one crosses one of the other.
//
// Columns count eastwards and rows northwards, from 0 at the south-western corner of the whole.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace itin::huge {

/// A range of posts, both ends included.
struct PostRange {
  std::int32_t first = 0, last = -1;

  std::int64_t count() const { return std::int64_t{last} - first + 1; }
  /// How many posts of the range are multiples of 2^steps.
  std::int64_t count_of_every(int steps) const { return (last >> steps) - ((first - 1) >> steps); }
  /// The fewest posts that reach as far on the lattice whose spacing is 2^steps times as large.
  PostRange coarser(int steps) const {
    return {first >> steps, static_cast<std::int32_t>((std::int64_t{last} + (1 << steps) - 1) >> steps)};
  }
  PostRange finer(int steps) const { return {first << steps, last << steps}; }
};

struct PostBox {
  PostRange columns, rows;

  bool empty() const { return columns.count() <= 0 || rows.count() <= 0; }
  std::int64_t count() const { return empty() ? 0 : columns.count() * rows.count(); }
  std::int64_t count_of_every(int steps) const {
    return empty() ? 0 : columns.count_of_every(steps) * rows.count_of_every(steps);
  }
  PostBox coarser(int steps) const { return {columns.coarser(steps), rows.coarser(steps)}; }
  PostBox finer(int steps) const { return {columns.finer(steps), rows.finer(steps)}; }
};

/// A number for each post of a box.
class Posts {
 public:
  explicit Posts(const PostBox& box)
      : box_(box), width_(static_cast<std::size_t>(box.columns.count())), z_(static_cast<std::size_t>(box.count())) {}

  const PostBox& box() const { return box_; }
  const std::int32_t* at(std::int32_t column, std::int32_t row) const { return z_.data() + index(column, row); }
  std::int32_t* at(std::int32_t column, std::int32_t row) { return z_.data() + index(column, row); }

 private:
  std::size_t index(std::int32_t column, std::int32_t row) const {
    return static_cast<std::size_t>(row - box_.rows.first) * width_ +
           static_cast<std::size_t>(column - box_.columns.first);
  }

  PostBox box_;
  std::size_t width_;
  std::vector<std::int32_t> z_;
};

/// Returns the posts about `box`, at half the spacing: kept(z) where there is a coarser post, amid(z, z, column, row)
/// between two. Precondition: `coarse` has box.coarser(1).
template <class Kept, class Amid>
Posts refined(const Posts& coarse, const PostBox& box, const Kept& kept, const Amid& amid) {
  Posts fine(box.coarser(1).finer(1));
  const PostRange columns = fine.box().columns, rows = fine.box().rows;
  for (std::int32_t row = rows.first; row <= rows.last; ++row) {
    const std::int32_t* south = coarse.at(columns.first / 2, row >> 1);
    const std::int32_t* north = coarse.at(columns.first / 2, (row + 1) >> 1);
    std::int32_t* out = fine.at(columns.first, row);
    const bool old = row % 2 == 0;
    for (std::int32_t column = columns.first;; column += 2, ++south, ++north) {
      *out++ = old ? kept(*south) : amid(*south, *north, column, row);
      if (column == columns.last) break;
      *out++ = amid(*north, south[1], column + 1, row);
    }
  }
  return fine;
}

}  // namespace itin::huge
