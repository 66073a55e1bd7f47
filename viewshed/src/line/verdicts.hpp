// The verdicts on a tile's cells.
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

/// Every observer's verdict on a cell, made one: the first of visible, undecided, hidden and outside that any of them
/// has. At first nobody looks.
class Verdicts {
 public:
  Verdicts() { values_.fill(Verdict::kOutside); }

  Verdict operator[](std::size_t cell) const { return values_[cell]; }
  /// A cell that one observer certainly sees need not be judged for the others.
  bool open(std::size_t cell) const { return values_[cell] != Verdict::kVisible; }

  void add(std::size_t cell, Verdict of_observer) {
    // Without branches, so that many cells are added at once.
    const Verdict value = values_[cell];
    const bool kept = of_observer == Verdict::kOutside || value == Verdict::kVisible ||
                      (of_observer == Verdict::kHidden && value != Verdict::kOutside);
    values_[cell] = kept ? value : of_observer;
  }
  void add(const TileValues<Verdict>& of_observer) {
    for (std::size_t cell = 0; cell < values_.size(); ++cell) add(cell, of_observer[cell]);
  }

  /// Counts the cells, and writes them to their places in the result.
  void store(const Tile& tile, Result& result, CellCounts& cells) const {
    for_each_row(tile, [&](std::size_t cell, RasterGrid::Cell first) {
      const auto columns = static_cast<std::size_t>(tile.columns);
      std::copy_n(values_.data() + cell, columns, result.visible.data() + result.grid.index(first));
      const auto count = [&, row = values_.begin() + static_cast<std::ptrdiff_t>(cell)](Verdict verdict) {
        return static_cast<std::uint64_t>(std::count(row, row + tile.columns, verdict));
      };
      cells.visible += count(Verdict::kVisible), cells.hidden += count(Verdict::kHidden);
      cells.undecided += count(Verdict::kUndecided), cells.outside += count(Verdict::kOutside);
    });
  }

 private:
  TileValues<Verdict> values_;
};

}  // namespace itin::viewshed
