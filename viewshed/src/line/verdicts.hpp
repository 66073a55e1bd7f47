// The verdicts of certified viewsheds on a tile's cells.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include <viewshed/viewshed.hpp>

#include "line/cell_tiles.hpp"

namespace itin::viewshed {

/// As rasters and polygons have it: the command line's contract.
constexpr std::uint8_t code_of(Verdict verdict) {
  return static_cast<std::uint8_t>(verdict);
}
inline std::vector<std::uint8_t> codes_of(const std::vector<Verdict>& verdicts) {
  std::vector<std::uint8_t> codes(verdicts.size());
  std::transform(verdicts.begin(), verdicts.end(), codes.begin(), code_of);
  return codes;
}

/// Adds a cell of this value.
inline void count(Verdict value, CellCounts& cells) {
  switch (value) {
    case Verdict::kVisible:
      ++cells.visible;
      break;
    case Verdict::kHidden:
      ++cells.hidden;
      break;
    case Verdict::kUndecided:
      ++cells.undecided;
      break;
    case Verdict::kOutside:
      ++cells.outside;
      break;
  }
}

/// Every observer's verdict on a cell, made one. At first nobody looks.
class Verdicts {
 public:
  Verdicts() { values_.fill(Verdict::kOutside); }

  /// The verdict with which the next observer begins: a cell that one certainly sees need not be judged for the others.
  Verdict open(std::size_t cell) const {
    return values_[cell] == Verdict::kVisible ? Verdict::kOutside : Verdict::kUndecided;
  }

  void add(const TileValues<Verdict>& of_observer) {
    for (std::size_t i = 0; i < values_.size(); ++i) {
      const Verdict v = of_observer[i];
      if (v == Verdict::kOutside || values_[i] == Verdict::kVisible) continue;
      if (values_[i] == Verdict::kOutside || v == Verdict::kVisible) {
        values_[i] = v;
      } else if (v == Verdict::kUndecided) {
        values_[i] = Verdict::kUndecided;
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
  TileValues<Verdict> values_;
};

}  // namespace itin::viewshed
