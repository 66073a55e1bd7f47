#include "scene/sweep/sector_profile.hpp"

#include <algorithm>
#include <limits>

#include "line/rounded_outwards.hpp"

namespace itin::viewshed {

Quadrant::Quadrant(const BinBounds& bins, double axis_column, double axis_row, Side side, double reach)
    : bins_(bins),
      along_columns_(side == kEast || side == kWest),
      runs_(along_columns_ ? bins.runs().eastwards() : bins.runs().southwards()),
      outward_(side == kEast || side == kSouth ? 1 : -1),
      major_(along_columns_ ? axis_column : axis_row),
      minor_(along_columns_ ? axis_row : axis_column),
      first_run_(static_cast<std::int64_t>(std::floor(major_ / static_cast<double>(kRun)))),
      lines_(along_columns_ ? bins.rows() : bins.columns()) {
  // An axis beside the bins begins with the run in front of it.
  first_run_ = outward_ > 0 ? std::max<std::int64_t>(0, first_run_) : std::min(runs_.a_line() - 1, first_run_);
  const double inside = major_ - static_cast<double>(first_run_) * static_cast<double>(kRun);
  first_end_ = outward_ > 0 ? static_cast<double>(kRun) - inside : inside;
  const auto slabs = static_cast<double>(outward_ > 0 ? runs_.a_line() - first_run_ : first_run_ + 1);
  const double reached = std::floor(std::max(0.0, reach - first_end_) / static_cast<double>(kRun)) + 2;
  per_end_.resize(static_cast<std::size_t>(std::max(0.0, std::min(slabs, reached))));
  for (std::size_t k = 0; k < per_end_.size(); ++k) per_end_[k] = 1 / end(k);
}

Sector::Sector(const Quadrant& quadrant, double from, double to, const Axis& axis)
    : quadrant_(quadrant), from_(from), to_(to), axis_(axis) {
  const double least_slope = from > 0 ? from
                             : to < 0 ? -to
                                      : 0,
               greatest_slope = std::max(std::abs(from), std::abs(to));
  least_ = 1 + least_slope * least_slope, greatest_ = 1 + greatest_slope * greatest_slope;
}

// Refraction that bends lines more than the Earth does raises what is far away.
double Sector::least_drop(std::size_t slab) const {
  return axis_.drop > 0 ? drop_at(std::max(0.0, quadrant_.begin(slab)), least_)
                        : drop_at(quadrant_.end(slab), greatest_);
}
double Sector::greatest_drop(std::size_t slab) const {
  return axis_.drop > 0 ? drop_at(quadrant_.end(slab), greatest_)
                        : drop_at(std::max(0.0, quadrant_.begin(slab)), least_);
}

Sector::Horizon Sector::continue_horizon(Horizon horizon, std::size_t end) const {
  for_each_slab(horizon.hidden.slab, end, [&](std::size_t k, std::int64_t first, std::int64_t last, bool inside) {
    pass(horizon.hidden, first, last, inside);
    const double rise = highest(k, first, last) + axis_.margin - axis_.top;
    // Ground that rises above the axis in its own slab may hide any line.
    const double steepest = rise <= 0 ? rise * quadrant_.per_end(k)
                            : k == 0  ? kFloatInfinity
                                      : rise * quadrant_.per_end(k - 1);
    horizon.above = std::max(horizon.above, steepest);
  });
  return horizon;
}

void SectorProfile::survey(const Sector& sector, const Sector::Horizon& known, std::size_t nearest, std::size_t count) {
  sector_.emplace(sector);
  known_ = known;
  nearest_ = nearest, count_ = count;
  const std::size_t blocks = (count + kBlock - 1) / kBlock;
  high_.resize(count), group_high_.resize(blocks * kBlock / kGroup), block_high_.resize(blocks);
  highs_known_.assign(blocks, false);
  hidden_below_.resize(count - nearest);
  sector.continue_horizon(known.hidden, count, [&](const Sector::Hidden& at) {
    if (at.slab >= nearest) hidden_below_[at.slab - nearest] = at.below;
  });
}

/// Computes the highs of a block's slabs when they are needed: most lines are decided by the blocks before.
void SectorProfile::survey_highs(std::size_t block) {
  highs_known_[block] = true;
  block_high_[block] = -kFloatInfinity;
  std::fill_n(group_high_.begin() + static_cast<std::ptrdiff_t>(block * kBlock / kGroup), kBlock / kGroup,
              -kFloatInfinity);
  const std::size_t end = std::min(count_, (block + 1) * kBlock);
  sector_->for_each_slab(block * kBlock, end, [&](std::size_t k, std::int64_t first, std::int64_t last, bool) {
    high_[k] = sector_->highest(k, first, last);
    group_high_[k / kGroup] = std::max(group_high_[k / kGroup], high_[k]);
    block_high_[block] = std::max(block_high_[block], high_[k]);
  });
}

}  // namespace itin::viewshed
