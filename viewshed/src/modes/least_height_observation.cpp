#include "modes/least_height_observation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "request/request.hpp"

namespace itin::viewshed {

LeastHeightObservation::LeastHeightObservation() {
  least_.fill(std::numeric_limits<double>::infinity());
}

bool LeastHeightObservation::open(const Look& look) const {
  return least_[look.cell] > 0 || value(look.cell) != Verdict::kVisible;
}

std::uint64_t LeastHeightObservation::look(const TileLook& tile) {
  FullSurface::TileWork& work = tile.work;
  work.targets.fill(kNoSurface);
  std::uint64_t lines = 0;
  tile.for_each_cell([&](const Look& look) {
    if (open(look)) lines += raise(tile, look) ? 1 : 0;
  });
  tile.surface.raise_from(tile.view, {lowest_, wanted_}, work);
  tile.for_each_cell([&](const Look& look) {
    if (!std::isnan(work.targets[look.cell]) && !std::isnan(work.seen[look.cell])) settle(tile, look);
  });
  return lines;
}

/// Where its line may end, if it needs one.
bool LeastHeightObservation::raise(const TileLook& tile, const Look& look) {
  const Eye& eye = tile.eye;
  FullSurface::TileWork& work = tile.work;
  if (eye.view.contains(look.dx, look.dy, look.dz, kSky) == false) return false;
  enter(look.cell);
  const double resolution = tile.surface.units().resolution, ground = work.ground[look.cell];
  // A target on the ground ends exactly there.
  const double wanted = ground + (eye.target(ground * resolution) - ground * resolution) / resolution;
  double lowest = ground, highest = kSky / resolution;
  if (const auto range = eye.view.heights_at(look.squared_distance())) {
    lowest = std::max(lowest, (eye.elevation + range->first) / resolution);
    highest = std::min(highest, (eye.elevation + range->second) / resolution);
  }
  // Heights that another observer is known to see need no line, unless the target that counts as visible is higher.
  highest = std::min(highest, std::max(ground + least_[look.cell] / resolution, wanted));
  if (lowest > highest) return false;
  work.targets[look.cell] = highest, lowest_[look.cell] = lowest, wanted_[look.cell] = wanted;
  return true;
}

void LeastHeightObservation::settle(const TileLook& tile, const Look& look) {
  const FullSurface::TileWork& work = tile.work;
  const Point3 highest = work.target(look.cell);
  if (tile.shadow != nullptr && tile.shadow->holds(highest.x, highest.y)) return;
  // At the eye's own place nothing hides.
  const double found = work.seen[look.cell], seen = std::isinf(found) ? lowest_[look.cell] : found;
  const double ground = work.ground[look.cell], wanted = wanted_[look.cell];
  const double height = seen <= ground ? 0 : (seen - ground) * tile.surface.units().resolution;
  least_[look.cell] = std::min(least_[look.cell], height);
  if (wanted >= lowest_[look.cell] && wanted <= highest.z && seen <= wanted) mark_visible(look.cell);
}

void LeastHeightObservation::store_row(std::size_t cell, std::size_t columns, std::size_t place, Result& result) const {
  for (std::size_t i = 0; i < columns; ++i) {
    const double least = least_[cell + i];
    result.least_height_m[place + i] =
        std::isinf(least) ? std::numeric_limits<float>::quiet_NaN() : static_cast<float>(least);
  }
}

}  // namespace itin::viewshed
