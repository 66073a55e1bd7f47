// The verdicts on a tile's cells.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include <viewshed/result.hpp>

#include "line/cell_tiles.hpp"

namespace itin::viewshed {

/// The number of a verdict in rasters and polygons, which is the command line's contract.
constexpr std::uint8_t code_of(Verdict verdict) {
  return static_cast<std::uint8_t>(verdict);
}
/// The codes of the verdicts, in the memory of the verdicts: each is stored as its code.
inline std::span<const std::uint8_t> codes_of(const std::vector<Verdict>& verdicts) {
  static_assert(std::is_same_v<std::underlying_type_t<Verdict>, std::uint8_t>);
  return {reinterpret_cast<const std::uint8_t*>(verdicts.data()), verdicts.size()};
}

/// How many of a tile's values are this verdict. It must not be kOutside, which also fills a smaller tile beyond its
/// cells.
inline std::uint64_t count_of(const TileValues<Verdict>& values, Verdict verdict) {
  std::uint64_t all = 0;
  // A byte holds the number of a few, and the compiler compares that many at once.
  constexpr std::size_t kFew = 128;
  static_assert(Tile::kSide * Tile::kSide % kFew == 0);
  for (std::size_t first = 0; first < values.size(); first += kFew) {
    std::uint8_t few = 0;
    for (std::size_t i = 0; i < kFew; ++i) few += values[first + i] == verdict ? 1 : 0;
    all += few;
  }
  return all;
}

/// Returns the better of two observers' verdicts on a cell: the first of visible, undecided, zone cut, hidden and
/// outside.
constexpr Verdict better_of(Verdict known, Verdict of_observer) {
  // There are no branches, so that many cells are judged at once.
  const bool kept = of_observer == Verdict::kOutside || known == Verdict::kVisible ||
                    (of_observer == Verdict::kHidden && known != Verdict::kOutside) ||
                    (of_observer == Verdict::kZoneCut && known == Verdict::kUndecided);
  return kept ? known : of_observer;
}

/// Every observer's verdict on a cell, made one: the best of them. At first every cell is outside.
class Verdicts {
 public:
  Verdicts() { values_.fill(Verdict::kOutside); }

  Verdict operator[](std::size_t cell) const { return values_[cell]; }
  /// A cell that one observer certainly sees need not be judged for the others.
  bool open(std::size_t cell) const { return values_[cell] != Verdict::kVisible; }

  void add(std::size_t cell, Verdict of_observer) { values_[cell] = better_of(values_[cell], of_observer); }
  void add(const TileValues<Verdict>& of_observer) {
    for (std::size_t cell = 0; cell < values_.size(); ++cell) add(cell, of_observer[cell]);
  }

  /// Counts the cells, and writes their verdicts to their places in the result.
  void store(const Tile& tile, Result& result, CellCounts& cells) const {
    for_each_row(tile, [&](std::size_t cell, RasterGrid::Cell first) {
      const auto columns = static_cast<std::size_t>(tile.columns), step = static_cast<std::size_t>(tile.step);
      Verdict* const to = result.visible.data() + result.grid.index(first);
      for (std::size_t i = 0; i < columns; ++i) to[i * step] = values_[cell + i];
    });
    cells += counts(tile);
  }

 private:
  CellCounts counts(const Tile& tile) const {
    const auto count = [&](Verdict verdict) { return count_of(values_, verdict); };
    CellCounts counts{count(Verdict::kVisible), count(Verdict::kHidden), count(Verdict::kUndecided)};
    counts.zone_cut = count(Verdict::kZoneCut);
    counts.outside = static_cast<std::uint64_t>(tile.rows * tile.columns) - counts.in_view();
    return counts;
  }

  TileValues<Verdict> values_;  ///< kOutside also beyond the cells of a smaller tile
};

}  // namespace itin::viewshed
