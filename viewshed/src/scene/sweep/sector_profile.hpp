// The surface along a narrow sector of the horizon about an upright axis: how low and how high it is from slab to slab.
// A slab is one run of bins long, along the sector's main direction.
//
// Heights are grid units, lowered by the drop at their distance from the axis, so that sight lines to the axis are
// straight. The lowest and the highest height of a slab are all it takes to decide most of them.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <itin/precondition.hpp>

#include "bounds/bin_bounds.hpp"
#include "line/infinity.hpp"

namespace itin::viewshed {

/// The plane of bins as seen from an axis towards one of four sides: `along` grows away from the axis in bins, by
/// columns or rows, and `across` is the bins' other coordinate, from the axis.
class Quadrant {
 public:
  enum Side : std::uint8_t { kEast, kWest, kSouth, kNorth };

  /// Holds what lies no farther along than `reach`, in bins.
  Quadrant(const BinBounds& bins, double axis_column, double axis_row, Side side, double reach = kInfinity);

  bool along_columns() const { return along_columns_; }
  double along(double column, double row) const { return ((along_columns_ ? column : row) - major_) * outward_; }
  double across(double column, double row) const { return (along_columns_ ? row : column) - minor_; }
  /// The column and the row of a place.
  Point2 position(double along, double across) const {
    const double major = major_ + along * static_cast<double>(outward_), minor = minor_ + across;
    return along_columns_ ? Point2{major, minor} : Point2{minor, major};
  }

  /// Slab k, a run of bins, reaches from `begin(k)` to `end(k)` along. Slab 0 begins somewhat behind the axis, or
  /// where the bins do.
  double begin(std::size_t slab) const { return end(slab) - static_cast<double>(kRun); }
  double end(std::size_t slab) const { return first_end_ + static_cast<double>(slab * kRun); }
  /// The slab at a distance; the last one for distances beyond the bins, or the reach. Preconditions: along >= 0, and
  /// there are slabs.
  std::size_t slab_at(double along) const {
    ITIN_PRECONDITION(along >= 0 && slabs() > 0);
    if (along <= first_end_) return 0;
    return std::min(slabs() - 1, static_cast<std::size_t>((along - first_end_) / static_cast<double>(kRun)) + 1);
  }
  std::size_t slabs() const { return per_end_.size(); }
  /// 1 / end(slab).
  double per_end(std::size_t slab) const { return per_end_[slab]; }

  /// Across a slab bins are numbered as columns or rows are; the axis itself stands at `minor()`.
  double minor() const { return minor_; }
  std::int64_t lines() const { return lines_; }
  static constexpr std::size_t kRun = RunBounds::kRun;
  /// The bounds of a slab, as RunBounds::Lines has them.
  float low(std::size_t slab, std::int64_t line) const { return runs_.low(run_of(slab), line); }
  float high(std::size_t slab, std::int64_t line) const { return runs_.high(run_of(slab), line); }
  /// The i-th bin of a run, nearest first; it reaches from begin(slab) + i one bin along. May lie just outside all
  /// bins.
  RasterGrid::Cell bin(std::size_t slab, std::size_t i, std::int64_t line) const {
    const auto at = static_cast<std::int64_t>(outward_ > 0 ? i : kRun - 1 - i);
    const std::int64_t major = run_of(slab) * static_cast<std::int64_t>(kRun) + at;
    return along_columns_ ? RasterGrid::Cell{major, line} : RasterGrid::Cell{line, major};
  }
  const BinBounds& bins() const { return bins_; }

 private:
  std::int64_t run_of(std::size_t slab) const { return first_run_ + outward_ * static_cast<std::int64_t>(slab); }

  const BinBounds& bins_;
  bool along_columns_;
  RunBounds::Lines runs_;
  std::int64_t outward_;
  double major_, minor_;
  std::int64_t first_run_, lines_;
  double first_end_;
  std::vector<double> per_end_;
};

/// The part of a quadrant within slopes [from, to] (across / along).
class Sector {
 public:
  struct Axis {
    double top = 0;     ///< the height that hiding is about
    double drop = 0;    ///< grid units of drop per squared bin
    double margin = 0;  ///< grid units by which bounds must decide: above all rounding
  };

  Sector(const Quadrant& quadrant, double from, double to, const Axis& axis);

  const Quadrant& quadrant() const { return quadrant_; }
  const Axis& axis() const { return axis_; }

  /// Lines up to the axis' top that rise by less than `below` outward per bin, and begin in this slab or farther away,
  /// are certainly hidden, by what lies nearer than the slab.
  struct Hidden {
    std::size_t slab = 0;
    double below = -kInfinity;
  };
  /// Continues `hidden` to the slab `end`. Calls visit(hidden) for every slab before it.
  template <class Visit>
  Hidden continue_horizon(Hidden hidden, std::size_t end, const Visit& visit) const;

  /// What is hidden, and what is not: of the lines to the top itself that rise by at least `above`, certainly none is
  /// hidden by what lies nearer than the slab.
  struct Horizon {
    Hidden hidden;
    double above = -kInfinity;
  };
  Horizon continue_horizon(Horizon horizon, std::size_t end) const;

  /// Calls visit(slab, first line, last line, whether all of them lie within the bins) from slab `first` on, before
  /// `end`.
  template <class Visit>
  void for_each_slab(std::size_t first, std::size_t end, const Visit& visit) const;

  /// The greatest height of a slab between two lines of bins, less the drop; grid units. Bare ground counts for
  /// nothing.
  float highest(std::size_t slab, std::int64_t first, std::int64_t last) const {
    // Rounding is within the margin.
    float high = -kFloatInfinity;
    for (std::int64_t line = first; line <= last; ++line) high = std::max(high, quadrant_.high(slab, line));
    return static_cast<float>(high - least_drop(slab));
  }

 private:
  // The least and the greatest drop within a slab, grid units.
  double least_drop(std::size_t slab) const;
  double greatest_drop(std::size_t slab) const;
  double drop_at(double along, double squared) const { return axis_.drop * squared * along * along; }
  /// Takes in the next slab.
  void pass(Hidden& hidden, std::int64_t first, std::int64_t last, bool inside) const;

  const Quadrant& quadrant_;
  double from_, to_;
  Axis axis_;
  double least_, greatest_;  ///< squared distances per squared distance along
};

/// How low and how high a sector is, slab by slab.
class SectorProfile {
 public:
  /// Surveys the slabs before `count`; hidden_below() holds for the slabs from `nearest` on. `known` is the horizon of
  /// slabs up to there. Reuses the memory that it has.
  void survey(const Sector& sector, const Sector::Horizon& known, std::size_t nearest, std::size_t count);

  /// Lines up to the axis' top that rise by less than this outward per bin, and begin in this slab, are certainly
  /// hidden.
  double hidden_below(std::size_t slab) const { return hidden_below_[slab - nearest_]; }

  /// Calls visit(slab), from `last` inwards, for every slab that may rise above the line. The line's height at the axis
  /// is line.at_axis(), and it rises by line.slope() outward per bin; both may change meanwhile. visit ends the search
  /// by returning false.
  template <class Line, class Visit>
  void search(std::size_t last, const Line& line, const Visit& visit);

 private:
  static constexpr std::size_t kGroup = 8, kBlock = 64;

  void survey_highs(std::size_t block);

  std::optional<Sector> sector_;
  Sector::Horizon known_;
  std::size_t nearest_ = 0, count_ = 0;
  std::vector<float> high_, group_high_, block_high_;  ///< the highest in a slab, in 8, in 64
  std::vector<bool> highs_known_;                      ///< one for each block of 64
  std::vector<double> hidden_below_;  ///< entry i: lines below it are hidden by what is nearer than slab nearest_ + i
};

template <class Visit>
void Sector::for_each_slab(std::size_t first_slab, std::size_t end, const Visit& visit) const {
  // Positions of eyes are rounded to a ten-thousandth of a grid unit.
  const double slack = std::max(1e-6, 1e-3 / quadrant_.bins().bin_size());
  const double low = quadrant_.minor() - slack + from_ * (from_ < 0 ? quadrant_.end(0) : quadrant_.begin(0));
  const double high = quadrant_.minor() + slack + to_ * (to_ < 0 ? quadrant_.begin(0) : quadrant_.end(0));
  const std::int64_t lines = quadrant_.lines();
  const double low_step = from_ * Quadrant::kRun, high_step = to_ * Quadrant::kRun;
  const double slabs = static_cast<double>(end);
  const bool inside = std::min(low, low + low_step * slabs) >= 0 &&
                      std::max(high, high + high_step * slabs) < static_cast<double>(lines);
  for (std::size_t k = first_slab; k < end; ++k) {
    const double first = low + low_step * static_cast<double>(k), last = high + high_step * static_cast<double>(k);
    if (inside) {
      visit(k, static_cast<std::int64_t>(first), static_cast<std::int64_t>(last), true);
    } else {
      const auto whole_first = static_cast<std::int64_t>(std::floor(first));
      const auto whole_last = static_cast<std::int64_t>(std::floor(last));
      visit(k, std::clamp<std::int64_t>(whole_first, 0, lines - 1), std::clamp<std::int64_t>(whole_last, 0, lines - 1),
            whole_first >= 0 && whole_last < lines);
    }
  }
}

inline void Sector::pass(Hidden& hidden, std::int64_t first, std::int64_t last, bool inside) const {
  const std::size_t k = hidden.slab++;
  float low = inside ? kFloatInfinity : -kFloatInfinity;
  // Each entry of low() covers two lines.
  const std::int64_t last_pair = std::max(first, last - 1);
  for (std::int64_t line = first + 2; line < last_pair; line += 2) low = std::min(low, quadrant_.low(k, line));
  low = std::min({low, quadrant_.low(k, first), quadrant_.low(k, last_pair)});
  const double rise = low - greatest_drop(k) - axis_.margin - axis_.top;
  hidden.below = std::max(hidden.below, rise * (rise < 0 ? quadrant_.per_end(k)
                                                : k == 0 ? 0
                                                         : quadrant_.per_end(k - 1)));
}

template <class Visit>
Sector::Hidden Sector::continue_horizon(Hidden hidden, std::size_t end, const Visit& visit) const {
  for_each_slab(hidden.slab, end, [&](std::size_t, std::int64_t first, std::int64_t last, bool inside) {
    visit(hidden);
    pass(hidden, first, last, inside);
  });
  return hidden;
}

template <class Line, class Visit>
void SectorProfile::search(std::size_t last, const Line& line, const Visit& visit) {
  const Quadrant& quadrant = sector_->quadrant();
  // The lowest point of the line over the slabs from first to last.
  const auto lowest = [&](std::size_t from, std::size_t to) {
    const double s = line.slope();
    return line.at_axis() - sector_->axis().margin + s * (s < 0 ? quadrant.end(to) : quadrant.begin(from));
  };
  const bool clear = line.slope() >= known_.above && line.at_axis() >= sector_->axis().top;
  const std::size_t first = clear ? known_.hidden.slab : 0;
  for (std::size_t block = last / kBlock + 1; block-- > first / kBlock;) {
    const std::size_t block_first = std::max(first, block * kBlock),
                      block_last = std::min(last, (block + 1) * kBlock - 1);
    if (!highs_known_[block]) survey_highs(block);
    if (block_high_[block] <= lowest(block_first, block_last)) continue;
    for (std::size_t group = block_last / kGroup + 1; group-- > block_first / kGroup;) {
      const std::size_t group_first = std::max(first, group * kGroup),
                        group_last = std::min(last, (group + 1) * kGroup - 1);
      if (group_high_[group] <= lowest(group_first, group_last)) continue;
      for (std::size_t slab = group_last + 1; slab-- > group_first;)
        if (high_[slab] > lowest(slab, slab) && !visit(slab)) return;
    }
  }
}

}  // namespace itin::viewshed
