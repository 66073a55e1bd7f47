#include "index/post_rows.hpp"

#include <algorithm>
#include <bit>
#include <limits>
#include <numeric>

#include <itin/parallel.hpp>
#include <itin/precondition.hpp>

namespace itin::viewshed {

namespace {

constexpr std::int64_t kBlockOfPosts = 8;  ///< side of the blocks whose greatest heights are kept

/// Tells whether a half of a cell holds the place (u, v) of it.
bool half_holds(LatticeTin::Half half, double u, double v) {
  switch (half) {
    case LatticeTin::kSouthWest:
      return v >= u;
    case LatticeTin::kNorthEast:
      return v <= u;
    case LatticeTin::kNorthWest:
      return u + v <= 1;
    case LatticeTin::kSouthEast:
      break;
  }
  return u + v >= 1;
}

}  // namespace

PostRows::PostRows(const LatticeTin& lattice, const PostBox& box, std::int64_t first, std::int64_t step)
    : box_(box), first_(first), step_(step), tile_columns_(lattice.tile_columns()), whole_(lattice.tiles.size()) {
  ITIN_PRECONDITION(box.columns() > 0 && box.rows() > 0 && step > 0);
  first_quotient_ = quotient_of(box.west - first);
  class_length_ = quotient_of(box.east - first) - first_quotient_ + 1;
  row_length_ = class_length_ * step;
  for (std::size_t t = 0; t < whole_.size(); ++t) whole_[t] = lattice.tiles[t].ground == LatticeTin::Ground::kWhole;
  const std::size_t places = static_cast<std::size_t>(row_length_ * box.rows()) + kTogether;
  heights_.resize(places);
  if (!whole(box)) halves_.resize(places);
  parallel_for(static_cast<std::size_t>(box.rows()),
               [&](std::size_t row) { copy_row(lattice, box.north + static_cast<std::int64_t>(row)); });
  block_columns_ = (box.columns() + kBlockOfPosts - 1) / kBlockOfPosts;
  const auto block_rows = static_cast<std::size_t>((box.rows() + kBlockOfPosts - 1) / kBlockOfPosts);
  highest_.resize(static_cast<std::size_t>(block_columns_) * block_rows, std::numeric_limits<std::int32_t>::min());
  parallel_for(block_rows, [&](std::size_t row) { find_highest(static_cast<std::int64_t>(row)); });
}

void PostRows::find_highest(std::int64_t block_row) {
  const std::int64_t first = box_.north + block_row * kBlockOfPosts,
                     last = std::min(first + kBlockOfPosts - 1, box_.south);
  for (std::int64_t row = first; row <= last; ++row) {
    const std::ptrdiff_t at_first = place(0, row);
    for (std::int64_t column = box_.west; column <= box_.east; ++column) {
      const std::int64_t block = block_row * block_columns_ + (column - box_.west) / kBlockOfPosts;
      std::int32_t& highest = highest_[static_cast<std::size_t>(block)];
      highest = std::max(highest, heights_[static_cast<std::size_t>(at_first + offset(column - first_, 0))]);
    }
  }
}

std::int32_t PostRows::highest(const PostBox& box) const {
  ITIN_PRECONDITION(box.west >= box_.west && box.north >= box_.north && box.east <= box_.east &&
                    box.south <= box_.south);
  std::int32_t highest = std::numeric_limits<std::int32_t>::min();
  for (std::int64_t row = (box.north - box_.north) / kBlockOfPosts; row <= (box.south - box_.north) / kBlockOfPosts;
       ++row)
    for (std::int64_t column = (box.west - box_.west) / kBlockOfPosts; column <= (box.east - box_.west) / kBlockOfPosts;
         ++column)
      highest = std::max(highest, highest_[static_cast<std::size_t>(row * block_columns_ + column)]);
  return highest;
}

void PostRows::copy_row(const LatticeTin& lattice, std::int64_t row) {
  if (row < 0 || row >= lattice.rows) return;
  const std::int64_t west = std::max<std::int64_t>(box_.west, 0),
                     east = std::min<std::int64_t>(box_.east, std::int64_t{lattice.columns} - 1);
  const std::ptrdiff_t at_first = place(0, row);
  for (std::int64_t column = west; column <= east; ++column) {
    const std::uint32_t cell = lattice.cell(static_cast<std::uint32_t>(column), static_cast<std::uint32_t>(row));
    const auto at = static_cast<std::size_t>(at_first + offset(column - first_, 0));
    if (lattice.read(cell)) {
      heights_[at] = lattice.posts(cell)[0];
    } else {
      // Tiles that end here have the post as well.
      lattice.for_each_tile_of(static_cast<std::uint32_t>(column), static_cast<std::uint32_t>(row),
                               [&](std::uint32_t tile, std::uint32_t post) {
                                 if (const auto& heights = lattice.tiles[tile].heights) heights_[at] = (*heights)[post];
                               });
    }
    if (!halves_.empty()) halves_[at] = lattice.halves(cell);
  }
}

std::uint64_t PostRows::triangle_count() const {
  if (halves_.empty()) return 2 * static_cast<std::uint64_t>((box_.columns() - 1) * (box_.rows() - 1));
  return std::accumulate(halves_.begin(), halves_.end(), std::uint64_t{0}, [](std::uint64_t sum, std::uint8_t there) {
    return sum + static_cast<std::uint64_t>(std::popcount(there));
  });
}

bool PostRows::whole(const PostBox& box) const {
  constexpr std::int64_t kSide = LatticeTin::kSide;
  const auto tile_rows = static_cast<std::int64_t>(whole_.size()) / tile_columns_;
  if (box.west < 0 || box.north < 0 || box.east > tile_columns_ * kSide || box.south > tile_rows * kSide) return false;
  for (std::int64_t row = box.north / kSide; row <= (box.south - 1) / kSide; ++row)
    for (std::int64_t column = box.west / kSide; column <= (box.east - 1) / kSide; ++column)
      if (!whole_[static_cast<std::size_t>(row * tile_columns_ + column)]) return false;
  return true;
}

HalfPlane PostRows::plane(std::ptrdiff_t place, std::int64_t columns, std::int64_t rows, LatticeTin::Half half) const {
  const auto height = [&](std::int64_t east, std::int64_t south) -> double {
    return heights_[static_cast<std::size_t>(place + offset(columns + east, rows + south))];
  };
  switch (half) {
    case LatticeTin::kSouthWest:
      return {height(0, 0), height(1, 1) - height(0, 1), height(0, 1) - height(0, 0)};
    case LatticeTin::kNorthEast:
      return {height(0, 0), height(1, 0) - height(0, 0), height(1, 1) - height(1, 0)};
    case LatticeTin::kNorthWest:
      return {height(0, 0), height(1, 0) - height(0, 0), height(0, 1) - height(0, 0)};
    case LatticeTin::kSouthEast:
      break;
  }
  return {height(0, 1) + height(1, 0) - height(1, 1), height(1, 1) - height(0, 1), height(1, 1) - height(1, 0)};
}

std::optional<double> PostRows::ground(std::ptrdiff_t place, double u, double v) const {
  // A place on the western or the northern side of a cell belongs to its neighbours, too.
  for (const std::int64_t west : {0, 1}) {
    for (const std::int64_t north : {0, 1}) {
      if ((west == 1 && u != 0) || (north == 1 && v != 0)) continue;
      const std::uint8_t there =
          halves_.empty() ? LatticeTin::kFalling : halves_[static_cast<std::size_t>(place + offset(-west, -north))];
      const double east = u + static_cast<double>(west), south = v + static_cast<double>(north);
      for (const auto half :
           {LatticeTin::kSouthWest, LatticeTin::kNorthEast, LatticeTin::kNorthWest, LatticeTin::kSouthEast}) {
        if ((there & half) != 0 && half_holds(half, east, south))
          return plane(place, -west, -north, half).at(east, south);
      }
    }
  }
  return std::nullopt;
}

}  // namespace itin::viewshed
