#include "cross_section/shared_cells.hpp"

#include <algorithm>
#include <cstdint>

namespace itin {

namespace {

/// The number of searches for single triangles that take about as long as a tile.
constexpr std::uint32_t kSearchesWorthATile = 512;

}  // namespace

bool SharedCells::is_worth_a_tile(Position place) {
  const auto sheet = tiles_.sheet_at(place, statistics_);
  return !sheet->has_cells() || ++sheet->searches > kSearchesWorthATile;
}

const LatticeSheet* SharedCells::sheet_of(const LatticeCell& cell) {
  if (!sheet_ || !sheet_->has(cell)) {
    if (std::min(cell.x, cell.y) < -kGridHalfSide || std::max(cell.x, cell.y) >= kGridHalfSide) return nullptr;
    sheet_ = tiles_.sheet_at({static_cast<std::int32_t>(cell.x), static_cast<std::int32_t>(cell.y)}, statistics_);
  }
  return sheet_->has(cell) && sheet_->stands_alone(cell) ? sheet_.get() : nullptr;
}

std::optional<LatticeCell> SharedCells::cell_about(const GridBox& box) {
  const auto sheet = tiles_.sheet_at({box.xmin, box.ymin}, statistics_);
  return sheet->has_cells() ? std::optional(sheet->first()) : std::nullopt;
}

}  // namespace itin
