// How low and how high a surface is along runs of bins, eastwards and southwards. Runs are kept in tiles, so that parts
// that are not looked at take no memory.
//
//   RunBounds bounds(columns, rows);
//   bounds.bound(tile, [&](std::int64_t column, std::int64_t row) { return RunBounds::Range<float>{low, high}; }, ...);
//   bounds.eastwards().low(run, line)
//
// A run is kRun bins of a row, or of a column; lines of runs are the rows, or the columns. Grid units, in single
// precision.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

namespace itin::viewshed {

class RunBounds {
 public:
  static constexpr std::int64_t kRun = 4;
  static constexpr std::int64_t kSide = 64;  ///< the side of a tile, bins

  /// At first all is bare: everything is -infinity.
  RunBounds(std::int64_t columns, std::int64_t rows)
      : columns_(columns),
        rows_(rows),
        tile_columns_((columns + kSide - 1) / kSide),
        tiles_(static_cast<std::size_t>(tile_columns_ * ((rows + kSide - 1) / kSide))),
        there_(tiles_.size(), &kBare) {}

  std::size_t tile_count() const { return tiles_.size(); }

  template <class Value>
  struct Range {
    Value low, high;
  };
  /// Sets the bounds of a tile. range_of(column, row) is the range of a bin, also of bins to the east and to the south
  /// of the tile; low(Value) and high(Value) convert its ends to single precision. May run for several tiles at once.
  template <class Value, class RangeOf, class Low, class High>
  void bound(std::size_t tile, const RangeOf& range_of, const Low& low, const High& high);

  /// The runs in one direction.
  class Lines;
  Lines eastwards() const;
  Lines southwards() const;

 private:
  static constexpr std::size_t kRunsPerSide = kSide / kRun;
  using Runs = std::array<float, kSide * kRunsPerSide>;  ///< line by line
  struct Tile {
    std::array<Runs, 2> low, high;  ///< eastwards, southwards
  };
  static const Tile kBare;

  std::int64_t columns_, rows_, tile_columns_;
  std::vector<std::unique_ptr<Tile>> tiles_;
  std::vector<const Tile*> there_;  ///< the same, or kBare
};

class RunBounds::Lines {
 public:
  /// The number of runs in a line.
  std::int64_t a_line() const { return a_line_; }
  /// A height at most as high as a run and the one beside it in the next line; -infinity where a part of them is bare.
  float low(std::int64_t run, std::int64_t line) const {
    const auto r = static_cast<std::size_t>(run), l = static_cast<std::size_t>(line);
    return tile(r, l).low[direction_][place(r, l)];
  }
  /// A height at least as high as a run; -infinity where all of it is bare.
  float high(std::int64_t run, std::int64_t line) const {
    const auto r = static_cast<std::size_t>(run), l = static_cast<std::size_t>(line);
    return tile(r, l).high[direction_][place(r, l)];
  }

 private:
  friend class RunBounds;
  const Tile& tile(std::size_t run, std::size_t line) const {
    return *tiles_[run / kRunsPerSide * along_ + line / kSide * across_];
  }
  static std::size_t place(std::size_t run, std::size_t line) {
    return line % kSide * kRunsPerSide + run % kRunsPerSide;
  }

  const Tile* const* tiles_ = nullptr;
  std::size_t direction_ = 0;
  std::int64_t a_line_ = 0;
  std::size_t along_ = 0, across_ = 0;  ///< tiles between neighbours
};

inline RunBounds::Lines RunBounds::eastwards() const {
  Lines lines;
  lines.tiles_ = there_.data(), lines.direction_ = 0;
  lines.a_line_ = (columns_ + kRun - 1) / kRun;
  lines.along_ = 1, lines.across_ = static_cast<std::size_t>(tile_columns_);
  return lines;
}

inline RunBounds::Lines RunBounds::southwards() const {
  Lines lines;
  lines.tiles_ = there_.data(), lines.direction_ = 1;
  lines.a_line_ = (rows_ + kRun - 1) / kRun;
  lines.along_ = static_cast<std::size_t>(tile_columns_), lines.across_ = 1;
  return lines;
}

template <class Value, class RangeOf, class Low, class High>
void RunBounds::bound(std::size_t tile, const RangeOf& range_of, const Low& low, const High& high) {
  // The tile's bins and the bins beside it, which are one column and one row more.
  constexpr std::int64_t kStride = kSide + 1;
  static thread_local std::array<Value, kStride * kStride> lows, highs;
  const std::int64_t first_column = static_cast<std::int64_t>(tile) % tile_columns_ * kSide,
                     first_row = static_cast<std::int64_t>(tile) / tile_columns_ * kSide;
  for (std::int64_t r = 0; r < kStride; ++r) {
    for (std::int64_t c = 0; c < kStride; ++c) {
      // Bins that do not exist count for nothing.
      const bool exists = first_column + c < columns_ && first_row + r < rows_;
      const auto [least, greatest] =
          exists ? range_of(first_column + c, first_row + r)
                 : Range<Value>{std::numeric_limits<Value>::max(), std::numeric_limits<Value>::lowest()};
      const auto at = static_cast<std::size_t>(r * kStride + c);
      lows[at] = least, highs[at] = greatest;
    }
  }
  if (!tiles_[tile]) tiles_[tile] = std::make_unique_for_overwrite<Tile>();
  there_[tile] = tiles_[tile].get();
  for (const std::size_t direction : {0, 1}) {
    const std::size_t step = direction == 0 ? 1 : kStride, beside = direction == 0 ? kStride : 1;
    for (std::size_t line = 0; line < kSide; ++line) {
      for (std::size_t run = 0; run < kRunsPerSide; ++run) {
        const std::size_t first = line * beside + run * kRun * step;
        Value least = lows[first], greatest = highs[first];
        for (std::size_t bin = first, i = 0; i < kRun; ++i, bin += step) {
          least = std::min({least, lows[bin], lows[bin + beside]});
          greatest = std::max(greatest, highs[bin]);
        }
        const std::size_t place = Lines::place(run, line);
        tiles_[tile]->low[direction][place] = low(least), tiles_[tile]->high[direction][place] = high(greatest);
      }
    }
  }
}

}  // namespace itin::viewshed
