#include "scene/sweep/horizon_view.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace itin::viewshed {

HorizonView::HorizonView(const BinBounds& bins, const Axis& axis, double drop, double grazing)
    : axis_(axis), column_(bins.column_at(axis.x)), row_(bins.row_at(axis.y)), bin_(bins.bin_size()) {
  const double bin = bins.bin_size();
  sector_axis_.top = axis.top;
  sector_axis_.drop = drop * bin * bin;
  // The margin is above all single precision's rounding of heights and of drops.
  const double greatest =
      bins.greatest_magnitude() + std::abs(axis.top) + 4 * std::abs(drop) * axis.radius * axis.radius;
  sector_axis_.margin = 100 * grazing + greatest * 0x1p-21;
  for (const Quadrant::Side side : {Quadrant::kEast, Quadrant::kWest, Quadrant::kSouth, Quadrant::kNorth})
    quadrants_.emplace_back(bins, column_, row_, side, axis.radius / bin + 1);
  fans_.resize(quadrants_.size());
}

bool HorizonView::reaches(const BinBox& box) const {
  const double east = column_ - std::clamp(column_, box.west, box.east),
               south = row_ - std::clamp(row_, box.north, box.south);
  return std::hypot(east, south) * bin_ <= axis_.radius * (1 + 1e-9);
}

double HorizonView::distance(const BinBox& box) const {
  return std::max(std::abs(column_ - std::clamp(column_, box.west, box.east)),
                  std::abs(row_ - std::clamp(row_, box.north, box.south)));
}

/// Returns the part of a box that lies in a quadrant, with slopes from -1 to 1; nothing where none does.
std::optional<HorizonView::Extent> HorizonView::extent(const Quadrant& quadrant, const BinBox& box) const {
  const auto range = [](double a, double b) { return std::pair(std::min(a, b), std::max(a, b)); };
  const auto [near, far] = range(quadrant.along(box.west, box.north), quadrant.along(box.east, box.south));
  const auto [low, high] = range(quadrant.across(box.west, box.north), quadrant.across(box.east, box.south));
  const double across = std::max({low, -high, 0.0}), nearest = std::max(near, across);
  if (quadrant.slabs() == 0 || far <= 0 || nearest > far) return std::nullopt;
  // The range is a hair wider, against rounding.
  Extent ends{std::max(low / (low < 0 ? nearest : far), -1.0) - 1e-9,
              std::min(high / (high > 0 ? nearest : far), 1.0) + 1e-9, nearest, far, 0};
  const double drop = sector_axis_.drop, farthest = std::max(-low, high);
  ends.least_drop = drop * (drop > 0 ? nearest * nearest + across * across : far * far + farthest * farthest);
  return ends;
}

void HorizonView::narrow(std::span<const BinBox> boxes) {
  // Boxes nearby may lie in all directions.
  constexpr double kNearby = 256;
  for (std::size_t i = 0; i < quadrants_.size(); ++i) {
    double from = 1, to = -1, farthest = 0;
    for (const BinBox& box : boxes) {
      const auto ends = distance(box) < kNearby ? std::nullopt : extent(quadrants_[i], box);
      if (!ends) continue;
      from = std::min(from, ends->from), to = std::max(to, ends->to);
      farthest = std::max(farthest, ends->nearest);
    }
    fans_[i].narrow(from, to, from <= to ? quadrants_[i].slab_at(farthest) : 0);
  }
}

void HorizonView::advance(double reach, const Progress& progress) {
  for (std::size_t i = 0; i < quadrants_.size(); ++i) {
    const Quadrant& quadrant = quadrants_[i];
    if (quadrant.slabs() == 0) continue;
    // Ground farther away begins in that slab or beyond.
    fans_[i].advance(quadrant, sector_axis_, quadrant.slab_at(std::min(reach, axis_.radius / bin_)), progress);
  }
}

bool HorizonView::hides(const BinBox& box, double elevation) const {
  if (distance(box) == 0) return false;
  for (std::size_t i = 0; i < quadrants_.size(); ++i) {
    const auto ends = extent(quadrants_[i], box);
    if (ends &&
        !hides(fans_[i].known(ends->from, ends->to, quadrants_[i].slab_at(ends->nearest)).hidden, *ends, elevation))
      return false;
  }
  return true;
}

bool HorizonView::hides(const Sector::Hidden& known, const Extent& ends, double elevation) const {
  return elevation < axis_.top + std::min(known.below * ends.nearest, known.below * ends.farthest) + ends.least_drop;
}

}  // namespace itin::viewshed
