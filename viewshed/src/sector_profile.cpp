#include "sector_profile.hpp"

#include <algorithm>

namespace itin::viewshed {

namespace {

constexpr float kNothing = -std::numeric_limits<float>::infinity();

}  // namespace

void SectorProfile::survey(const Quadrant& quadrant, double from, double to, std::size_t count, const Axis& axis) {
  first_width_ = quadrant.first_width(), margin_ = axis.margin;
  high_.resize(count), hidden_below_.resize(count);
  group_high_.assign((count + kGroup - 1) / kGroup, kNothing);
  block_high_.assign((count + kGroup * kGroup - 1) / (kGroup * kGroup), kNothing);
  const double least_slope = from > 0 ? from : to < 0 ? -to : 0, greatest_slope = std::max(std::abs(from), std::abs(to));
  const double near_drop = axis.drop * (1 + least_slope * least_slope);
  const double far_drop = axis.drop * (1 + greatest_slope * greatest_slope);
  // Positions of eyes are rounded to a ten-thousandth of a grid unit.
  const double slack = std::max(1e-6, 1e-3 / quadrant.bins().bin_size());
  const double origin = quadrant.minor() - slack, width = 2 * slack;
  double hidden_below = -std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < count; ++k) {
    const double begin = quadrant.begin(k), end = quadrant.end(k);
    const double low_edge = from * (from < 0 ? end : begin), high_edge = to * (to < 0 ? begin : end);
    const auto first = static_cast<std::int64_t>(std::floor(origin + low_edge));
    const auto last = static_cast<std::int64_t>(std::floor(origin + width + high_edge));
    float low = std::numeric_limits<float>::infinity(), high = kNothing;
    for (std::int64_t line = std::max<std::int64_t>(first, 0); line <= std::min(last, quadrant.lines() - 1); ++line) {
      const BinnedHeights::Bounds& bounds = quadrant.bounds(k, line);
      low = std::min(low, bounds.low), high = std::max(high, bounds.high);
    }
    if (first < 0 || last >= quadrant.lines()) low = kNothing;
    // Ground that is bare beyond the grid counts for nothing, and a float's rounding is within the margin.
    high_[k] = static_cast<float>(high - near_drop * begin * begin);
    const double rise = low - far_drop * end * end - axis.margin - axis.top;
    if (end > 0) hidden_below = std::max(hidden_below, rise / end);
    if (begin > 0) hidden_below = std::max(hidden_below, rise / begin);
    hidden_below_[k] = hidden_below;
    group_high_[k / kGroup] = std::max(group_high_[k / kGroup], high_[k]);
    block_high_[k / (kGroup * kGroup)] = std::max(block_high_[k / (kGroup * kGroup)], high_[k]);
  }
}

}  // namespace itin::viewshed
