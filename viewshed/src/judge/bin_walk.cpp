#include "judge/bin_walk.hpp"

#include <algorithm>
#include <cmath>

#include <itin/parallel.hpp>

#include "line/infinity.hpp"
#include "line/rounded_outwards.hpp"

namespace itin::viewshed {

namespace {

constexpr std::int64_t kBlock = 8;  ///< bins along the side of a block

/// The columns, or rows, that a line crosses within a stretch of it, one after the other.
class Crossing {
 public:
  /// Columns are `size` bins wide and numbered from `least` to `greatest`; the line is at `at + s per`, in bins, at the
  /// fraction s.
  Crossing(double at, double per, double begin, double size, std::int64_t least, std::int64_t greatest)
      : step_(per < 0 ? -1 : 1), number_(std::clamp(number_at((at + begin * per) / size), least, greatest)) {
    if (per == 0) return;
    next_ = (static_cast<double>(number_ + (per > 0 ? 1 : 0)) * size - at) / per;
    spacing_ = size / std::abs(per);
  }

  std::int64_t number() const { return number_; }
  /// The fraction at which the line leaves the column, or row.
  double end() const { return next_; }
  void advance() { number_ += step_, next_ += spacing_; }

 private:
  static std::int64_t number_at(double v) { return static_cast<std::int64_t>(std::floor(v)); }

  std::int64_t step_, number_;
  double next_ = kInfinity, spacing_ = 0;
};

}  // namespace

/// A sight line over the bins, with heights that allow for the Earth's curvature; columns and rows are those of bins.
struct BinWalk::Line {
  double column, row, columns, rows;  ///< where it begins, and how far it goes
  double from_z, rise, bulge;

  double height(double s) const { return from_z + s * (rise - bulge * (1 - s)); }
  /// A height that no point of the stretch lies below.
  double lowest(const Stretch& within) const {
    const double length = within.last - within.first;
    return std::min(height(within.first), height(within.last)) - std::max(bulge, 0.0) * length * length / 4;
  }
  /// The stretch that lies over the bins.
  Stretch over(const SurfaceBins& bins) const {
    Stretch all{0, 1};
    const auto limit = [&](double at, double per, double count) {
      if (per == 0) {
        if (at < 0 || at > count) all.last = -1;
        return;
      }
      const double a = -at / per, b = (count - at) / per;
      all.first = std::max(all.first, std::min(a, b)), all.last = std::min(all.last, std::max(a, b));
    };
    limit(column, columns, static_cast<double>(bins.columns()));
    limit(row, rows, static_cast<double>(bins.rows()));
    return all;
  }
  /// Calls visit(place, stretch) for the squares of this size that the line crosses, among those from `first` to
  /// `last`, until one call returns false; returns whether none did.
  template <class Visit>
  bool for_each_square(Stretch within, double size, RasterGrid::Cell first, RasterGrid::Cell last,
                       const Visit& visit) const {
    Crossing across(column, columns, within.first, size, first.column, last.column);
    Crossing down(row, rows, within.first, size, first.row, last.row);
    while (across.number() >= first.column && across.number() <= last.column && down.number() >= first.row &&
           down.number() <= last.row) {
      const double end = std::min({across.end(), down.end(), within.last});
      if (!visit(RasterGrid::Cell{across.number(), down.number()}, Stretch{within.first, std::max(within.first, end)}))
        return false;
      if (end >= within.last) break;
      within.first = std::max(within.first, end);
      across.end() < down.end() ? across.advance() : down.advance();
    }
    return true;
  }
};

BinWalk::BinWalk(const SurfaceBins& bins, double drop)
    : bins_(bins),
      drop_(drop),
      block_columns_((bins.columns() + kBlock - 1) / kBlock),
      block_rows_((bins.rows() + kBlock - 1) / kBlock),
      block_high_(static_cast<std::size_t>(block_columns_ * block_rows_)) {
  parallel_for(static_cast<std::size_t>(block_rows_), [&](std::size_t r) {
    const auto row = static_cast<std::int64_t>(r) * kBlock;
    for (std::int64_t block = 0; block < block_columns_; ++block) {
      float high = -kFloatInfinity;
      for (std::int64_t y = row; y < std::min(row + kBlock, bins.rows()); ++y)
        for (std::int64_t x = block * kBlock; x < std::min((block + 1) * kBlock, bins.columns()); ++x)
          high = std::max(high, bins.range({x, y}).high);
      block_high_[r * static_cast<std::size_t>(block_columns_) + static_cast<std::size_t>(block)] = high;
    }
  });
}

Verdict BinWalk::along(const Point3& from, const Point3& to) const {
  const double dx = to.x - from.x, dy = to.y - from.y;
  const double column = bins_.column_at(from.x), row = bins_.row_at(from.y);
  const Line line{column, row,           bins_.column_at(to.x) - column, bins_.row_at(to.y) - row,
                  from.z, to.z - from.z, drop_ * (dx * dx + dy * dy)};
  const Stretch all = line.over(bins_);
  if (all.first > all.last) return Verdict::kVisible;
  Verdict verdict = Verdict::kVisible;
  const auto pass = [&](const SurfaceBins::Range& range, const Stretch& within) {
    if (range.low > std::min(line.height(within.first), line.height(within.last))) return false;
    if (range.high > line.lowest(within)) verdict = Verdict::kUndecided;
    return true;
  };
  const auto pass_bin = [&](RasterGrid::Cell bin, const Stretch& within) {
    const SurfaceBins::Parts* const parts = bins_.parts(bin);
    if (parts == nullptr || bins_.range(bin).high <= line.lowest(within)) return pass(bins_.range(bin), within);
    constexpr std::int64_t kParts = SurfaceBins::kParts;
    const RasterGrid::Cell first{bin.column * kParts, bin.row * kParts};
    return line.for_each_square(within, 1.0 / kParts, first, {first.column + kParts - 1, first.row + kParts - 1},
                                [&](RasterGrid::Cell part, const Stretch& in_part) {
                                  const std::int64_t at = (part.row - first.row) * kParts + part.column - first.column;
                                  return pass((*parts)[static_cast<std::size_t>(at)], in_part);
                                });
  };
  const auto pass_block = [&](RasterGrid::Cell block, const Stretch& within) {
    if (block_high_[static_cast<std::size_t>(block.row * block_columns_ + block.column)] <= line.lowest(within))
      return true;
    const RasterGrid::Cell first{block.column * kBlock, block.row * kBlock};
    return line.for_each_square(
        within, 1, first,
        {std::min(first.column + kBlock, bins_.columns()) - 1, std::min(first.row + kBlock, bins_.rows()) - 1},
        pass_bin);
  };
  const bool passed = line.for_each_square(all, kBlock, {0, 0}, {block_columns_ - 1, block_rows_ - 1}, pass_block);
  return passed ? verdict : Verdict::kHidden;
}

}  // namespace itin::viewshed
