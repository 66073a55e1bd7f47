// What certified viewsheds say of a tile's cells.
#pragma once

#include <viewshed/certified.hpp>
#include <viewshed/viewshed.hpp>

#include "cell_tiles.hpp"

namespace itin::viewshed {

/// Adds a cell of this value.
inline void count(std::uint8_t value, CellCounts& cells) {
  switch (value) {
    case kCertainlyVisible:
      ++cells.visible;
      break;
    case kCertainlyHidden:
      ++cells.hidden;
      break;
    case kUndecided:
      ++cells.undecided;
      break;
    default:
      ++cells.outside;
  }
}

/// Every observer's verdict on a cell, made one. At first nobody looks.
class Verdicts {
 public:
  Verdicts() { values_.fill(kOutside); }

  /// What a cell is to be judged as next: what one observer certainly sees need not be asked of the others.
  std::uint8_t open(std::size_t cell) const { return values_[cell] == kCertainlyVisible ? kOutside : kUndecided; }

  void add(const TileValues<std::uint8_t>& of_observer) {
    for (std::size_t i = 0; i < values_.size(); ++i) {
      const std::uint8_t v = of_observer[i];
      if (v == kOutside || values_[i] == kCertainlyVisible) continue;
      if (values_[i] == kOutside || v == kCertainlyVisible) {
        values_[i] = v;
      } else if (v == kUndecided) {
        values_[i] = kUndecided;
      }
    }
  }

  /// Counts the cells, and writes them to their places in the result.
  void store(const Tile& tile, Result& result, CellCounts& cells) const {
    for_each_cell(tile, [&](std::size_t cell, RasterGrid::Cell place) {
      result.visible[result.grid.index(place)] = values_[cell];
      count(values_[cell], cells);
    });
  }

 private:
  TileValues<std::uint8_t> values_;
};

}  // namespace itin::viewshed
