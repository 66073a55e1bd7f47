#include "sector_profile.hpp"

#include <algorithm>
#include <limits>

namespace itin::viewshed {

namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

}  // namespace

Quadrant::Quadrant(const BinnedHeights& bins, double axis_column, double axis_row, Side side)
    : bins_(bins),
      along_columns_(side == kEast || side == kWest),
      runs_(along_columns_ ? bins.eastwards() : bins.southwards()),
      outward_(side == kEast || side == kSouth ? 1 : -1),
      major_(along_columns_ ? axis_column : axis_row),
      minor_(along_columns_ ? axis_row : axis_column),
      first_run_(static_cast<std::int64_t>(std::floor(major_ / static_cast<double>(kRun)))),
      lines_(along_columns_ ? bins.rows() : bins.columns()) {
  // From an axis beside the bins, those in front of it.
  first_run_ = outward_ > 0 ? std::max<std::int64_t>(0, first_run_) : std::min(runs_.a_line - 1, first_run_);
  const double inside = major_ - static_cast<double>(first_run_) * static_cast<double>(kRun);
  first_end_ = outward_ > 0 ? static_cast<double>(kRun) - inside : inside;
  const std::int64_t slabs = outward_ > 0 ? runs_.a_line - first_run_ : first_run_ + 1;
  per_end_.resize(static_cast<std::size_t>(std::max<std::int64_t>(0, slabs)));
  for (std::size_t k = 0; k < per_end_.size(); ++k) per_end_[k] = 1 / end(k);
}

void SectorProfile::survey(const Quadrant& quadrant, double from, double to, std::size_t nearest, std::size_t count,
                           const Axis& axis) {
  quadrant_ = &quadrant, from_ = from, to_ = to, nearest_ = nearest, count_ = count, axis_ = axis;
  highs_known_ = false;
  const double least_slope = from > 0 ? from
                             : to < 0 ? -to
                                      : 0,
               greatest_slope = std::max(std::abs(from), std::abs(to));
  least_ = 1 + least_slope * least_slope, greatest_ = 1 + greatest_slope * greatest_slope;
  survey_lows();
}

/// Calls visit(slab, first line, last line, whether all of them lie within the bins), nearest first.
template <class Visit>
void SectorProfile::for_each_slab(const Visit& visit) const {
  // Positions of eyes are rounded to a ten-thousandth of a grid unit.
  const double slack = std::max(1e-6, 1e-3 / quadrant_->bins().bin_size());
  const double low = quadrant_->minor() - slack + from_ * (from_ < 0 ? quadrant_->end(0) : quadrant_->begin(0));
  const double high = quadrant_->minor() + slack + to_ * (to_ < 0 ? quadrant_->begin(0) : quadrant_->end(0));
  const std::int64_t lines = quadrant_->lines();
  const double low_step = from_ * Quadrant::kRun, high_step = to_ * Quadrant::kRun;
  const double slabs = static_cast<double>(count_);
  const bool inside = std::min(low, low + low_step * slabs) >= 0 &&
                      std::max(high, high + high_step * slabs) < static_cast<double>(lines);
  for (std::size_t k = 0; k < count_; ++k) {
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

/// Within a slab. Refraction that bends lines more than the Earth does raises what is far away.
double SectorProfile::drop_at(double along, double squared) const {
  return axis_.drop * squared * along * along;
}
double SectorProfile::least_drop(std::size_t slab) const {
  return axis_.drop > 0 ? drop_at(std::max(0.0, quadrant_->begin(slab)), least_)
                        : drop_at(quadrant_->end(slab), greatest_);
}
double SectorProfile::greatest_drop(std::size_t slab) const {
  return axis_.drop > 0 ? drop_at(quadrant_->end(slab), greatest_)
                        : drop_at(std::max(0.0, quadrant_->begin(slab)), least_);
}

void SectorProfile::survey_lows() {
  hidden_below_.resize(count_ - nearest_);
  const float* const lows = quadrant_->runs().low.data();
  double hidden_below = -std::numeric_limits<double>::infinity();
  double per_begin = 0;
  for_each_slab([&](std::size_t k, std::int64_t first, std::int64_t last, bool inside) {
    if (k >= nearest_) hidden_below_[k - nearest_] = hidden_below;
    float low = inside ? kInfinity : -kInfinity;
    // Each covers two lines.
    const std::int64_t last_pair = std::max(first, last - 1);
    for (std::int64_t line = first + 2; line < last_pair; line += 2) low = std::min(low, lows[quadrant_->run(k, line)]);
    low = std::min({low, lows[quadrant_->run(k, first)], lows[quadrant_->run(k, last_pair)]});
    const double per_end = quadrant_->per_end(k);
    const double rise = low - greatest_drop(k) - axis_.margin - axis_.top;
    hidden_below = std::max(hidden_below, rise * (rise < 0 ? per_end : per_begin));
    per_begin = per_end;
  });
}

void SectorProfile::survey_highs() {
  highs_known_ = true;
  high_.resize(count_);
  group_high_.assign((count_ + kGroup - 1) / kGroup, -kInfinity);
  block_high_.assign((count_ + kBlock - 1) / kBlock, -kInfinity);
  const float* const highs = quadrant_->runs().high.data();
  for_each_slab([&](std::size_t k, std::int64_t first, std::int64_t last, bool) {
    // Ground that is bare beyond the bins counts for nothing, and a float's rounding is within the margin.
    float high = -kInfinity;
    for (std::int64_t line = first; line <= last; ++line) high = std::max(high, highs[quadrant_->run(k, line)]);
    high_[k] = static_cast<float>(high - least_drop(k));
    group_high_[k / kGroup] = std::max(group_high_[k / kGroup], high_[k]);
    block_high_[k / kBlock] = std::max(block_high_[k / kBlock], high_[k]);
  });
}

}  // namespace itin::viewshed
