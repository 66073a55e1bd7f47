// Blocks of a tile's cells that are decided at once where bounds allow, and otherwise quarter by quarter.
//
//   void hide(const CellBlock& block) {
//     if (horizon.hides(box_about(block, centres, bins), highest)) return mark(block);
//     if (block.side() > 1) for_each_quarter(block, [&](const CellBlock& quarter) { hide(quarter); });
//   }
//   hide(all_of(tile));
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>

#include <itin/precondition.hpp>

#include "bounds/bin_bounds.hpp"
#include "line/cell_tiles.hpp"

namespace itin::viewshed {

/// A rectangle of a tile's cells; the ends are exclusive.
struct CellBlock {
  std::size_t row = 0, row_end = 0, column = 0, column_end = 0;
  std::size_t side() const { return std::max(row_end - row, column_end - column); }
};

inline CellBlock all_of(const Tile& tile) {
  return {0, static_cast<std::size_t>(tile.rows), 0, static_cast<std::size_t>(tile.columns)};
}

/// Calls visit(block) for the quarters that have cells. Precondition: there is more than one cell.
template <class Visit>
void for_each_quarter(const CellBlock& block, const Visit& visit) {
  ITIN_PRECONDITION((block.row_end - block.row) * (block.column_end - block.column) > 1);
  const std::size_t row = block.row + (block.row_end - block.row + 1) / 2,
                    column = block.column + (block.column_end - block.column + 1) / 2;
  for (const auto& [first_row, row_end] : {std::pair(block.row, row), std::pair(row, block.row_end)})
    for (const auto& [first, end] : {std::pair(block.column, column), std::pair(column, block.column_end)})
      if (first_row < row_end && first < end) visit(CellBlock{first_row, row_end, first, end});
}

/// Calls visit(cell in the tile) for each of the block's cells, row by row.
template <class Visit>
void for_each_cell(const CellBlock& block, const Visit& visit) {
  for (std::size_t row = block.row; row < block.row_end; ++row)
    for (std::size_t column = block.column; column < block.column_end; ++column) visit(row * Tile::kSide + column);
}

/// The box about the centres of the block's cells.
inline BinBox box_about(const CellBlock& block, const TileCentres& at, const BinGrid& bins) {
  return {bins.column_at(at.x[block.column]), bins.row_at(at.y[block.row]), bins.column_at(at.x[block.column_end - 1]),
          bins.row_at(at.y[block.row_end - 1])};
}

}  // namespace itin::viewshed
