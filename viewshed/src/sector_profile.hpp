// The surface along a narrow sector of the horizon about an upright axis: how low and how high it is from slab to slab,
// the slabs being one bin wide across the sector's main direction.
//
// Heights are grid units, lowered by the drop at their distance from the axis: then sight lines to the axis are
// straight, and two heights that a surface keeps between are all it takes to decide most of them.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "binned_heights.hpp"

namespace itin::viewshed {

/// The plane of bins as seen from an axis towards one of four sides: `along` grows away from the axis in bins, by columns
/// or rows, and `across` is the bins' other coordinate, from the axis.
class Quadrant {
 public:
  /// 0 to 3: east, west, south, north.
  Quadrant(const BinnedHeights& bins, double axis_column, double axis_row, unsigned side)
      : bins_(bins), by_row_(side < 2), outward_(side % 2 == 0 ? 1 : -1) {
    const double major = by_row_ ? axis_column : axis_row;
    minor_ = by_row_ ? axis_row : axis_column;
    major_ = major;
    first_bin_ = static_cast<std::int64_t>(std::floor(major));
    const double inside = major - static_cast<double>(first_bin_);
    first_width_ = outward_ > 0 ? 1 - inside : inside;
    slabs_ = static_cast<std::size_t>(outward_ > 0 ? (by_row_ ? bins.columns() : bins.rows()) - first_bin_ : first_bin_ + 1);
    lines_ = by_row_ ? bins.rows() : bins.columns();
  }

  double along(double column, double row) const { return ((by_row_ ? column : row) - major_) * outward_; }
  double across(double column, double row) const { return (by_row_ ? row : column) - minor_; }
  /// Slab k reaches from `begin(k)` to `end(k)` along; slab 0 begins at the axis.
  double begin(std::size_t slab) const { return slab == 0 ? 0 : first_width_ + static_cast<double>(slab) - 1; }
  double end(std::size_t slab) const { return first_width_ + static_cast<double>(slab); }
  std::size_t slab_at(double along) const {
    return along <= first_width_ ? 0 : static_cast<std::size_t>(along - first_width_) + 1;
  }
  double first_width() const { return first_width_; }
  std::size_t slabs() const { return slabs_; }

  /// Bins across a slab are numbered as columns or rows are; the axis itself stands at `minor()`.
  double minor() const { return minor_; }
  std::int64_t lines() const { return lines_; }
  const BinnedHeights::Bounds& bounds(std::size_t slab, std::int64_t line) const {
    const auto bin = static_cast<std::size_t>(bin_of(slab));
    return by_row_ ? bins_.row(line)[bin] : bins_.column(line)[bin];
  }
  std::span<const std::uint32_t> triangles(std::size_t slab, std::int64_t line) const {
    return by_row_ ? bins_.triangles(bin_of(slab), line) : bins_.triangles(line, bin_of(slab));
  }
  const BinnedHeights& bins() const { return bins_; }

 private:
  std::int64_t bin_of(std::size_t slab) const { return first_bin_ + outward_ * static_cast<std::int64_t>(slab); }

  const BinnedHeights& bins_;
  bool by_row_;
  std::int64_t outward_;
  double major_ = 0, minor_ = 0, first_width_ = 0;
  std::int64_t first_bin_ = 0, lines_ = 0;
  std::size_t slabs_ = 0;
};

/// What lies within slopes [from, to] of a quadrant (across / along).
class SectorProfile {
 public:
  struct Axis {
    double top = 0;     ///< the height that hiding is about
    double drop = 0;    ///< grid units of drop a squared bin
    double margin = 0;  ///< grid units by which bounds must decide: above all rounding
  };

  /// Of the slabs up to `count`. Reuses what memory it has.
  void survey(const Quadrant& quadrant, double from, double to, std::size_t count, const Axis& axis);

  /// Whether lines up to the axis' top that rise by `slope` outward a bin, and begin in this slab or beyond, are
  /// certainly hidden.
  bool hides(double slope, std::size_t slab) const { return slab > 0 && slope < hidden_below_[slab - 1]; }

  /// Calls visit(slab) from `last` inwards for every slab that may rise above a line of `height()` at the axis and
  /// `slope()` outward a bin; both may change meanwhile, and visit may end the search by returning false.
  template <class Height, class Slope, class Visit>
  void search(std::size_t last, const Height& height, const Slope& slope, const Visit& visit) const;

 private:
  static constexpr std::size_t kGroup = 8;

  double first_width_ = 0, margin_ = 0;
  std::vector<float> high_, group_high_, block_high_;  ///< of a slab, of 8, of 64
  std::vector<double> hidden_below_;                   ///< by what the slabs up to this hide
};

template <class Height, class Slope, class Visit>
void SectorProfile::search(std::size_t last, const Height& height, const Slope& slope, const Visit& visit) const {
  // The lowest point of the line over the slabs from first to last.
  const auto lowest = [&](std::size_t from, std::size_t to) {
    const double s = slope();
    return height() - margin_ + s * (first_width_ + static_cast<double>(s < 0 ? to : from) - (s < 0 ? 0 : 1));
  };
  for (std::size_t block = last / (kGroup * kGroup) + 1; block-- > 0;) {
    const std::size_t block_first = block * kGroup * kGroup, block_last = std::min(last, block_first + kGroup * kGroup - 1);
    if (block_high_[block] <= lowest(block_first, block_last)) continue;
    for (std::size_t group = block_last / kGroup + 1; group-- > block_first / kGroup;) {
      const std::size_t group_first = group * kGroup, group_last = std::min(last, group_first + kGroup - 1);
      if (group_high_[group] <= lowest(group_first, group_last)) continue;
      for (std::size_t slab = group_last + 1; slab-- > group_first;)
        if (high_[slab] > lowest(slab, slab) && !visit(slab)) return;
    }
  }
}

}  // namespace itin::viewshed
