#include "modes/least_height_observation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "line/infinity.hpp"
#include "request/request.hpp"

namespace itin::viewshed {

LeastHeightObservation::LeastHeightObservation() {
  least_.fill(kInfinity);
  open_.fill(kInfinity);
}

bool LeastHeightObservation::open(const CellView& view) const {
  return least_[view.cell] > 0 || verdicts().open(view.cell);
}

std::uint64_t LeastHeightObservation::observe(const TileView& tile) {
  ExactScene::TileCells& cells = tile.cells();
  cells.targets.fill(kNoSurface);
  const auto ends = std::make_unique<Ends>();
  std::uint64_t lines = 0;
  tile.for_each_cell([&](const CellView& view) {
    if (open(view)) lines += raise(tile, view, *ends) ? 1 : 0;
  });
  tile.work.surface().raise_from(tile.from().view, {ends->lowest, ends->wanted}, cells, tile.progress);
  tile.for_each_cell([&](const CellView& view) {
    if (!std::isnan(cells.targets[view.cell]) && !std::isnan(cells.seen[view.cell])) record(tile, view, *ends);
  });
  return lines;
}

/// Sets where the cell's line may end, and returns whether it needs one.
bool LeastHeightObservation::raise(const TileView& tile, const CellView& view, Ends& ends) {
  const Eye& eye = tile.eye();
  ExactScene::TileCells& cells = tile.cells();
  if (eye.view.contains(view.dx, view.dy, view.dz, kSky) == false) return false;
  verdicts().add(view.cell, Verdict::kHidden);
  const double resolution = tile.resolution(), ground = cells.ground[view.cell];
  // A target on the ground ends exactly there.
  const double wanted = ground + (eye.target(ground * resolution) - ground * resolution) / resolution;
  double lowest = ground, highest = kSky / resolution;
  if (const auto range = eye.view.heights_at(view.squared_distance())) {
    lowest = std::max(lowest, (eye.elevation + range->first) / resolution);
    highest = std::min(highest, (eye.elevation + range->second) / resolution);
  }
  // Heights that another observer is known to see need no line, unless the target that counts as visible is higher.
  highest = std::min(highest, std::max(ground + least_[view.cell] / resolution, wanted));
  if (lowest > highest) return false;
  cells.targets[view.cell] = highest, ends.lowest[view.cell] = lowest, ends.wanted[view.cell] = wanted;
  return true;
}

void LeastHeightObservation::record(const TileView& tile, const CellView& view, const Ends& ends) {
  const ExactScene::TileCells& cells = tile.cells();
  const Point3 highest = cells.target(view.cell);
  const bool over_missing = tile.crosses_void(highest.x, highest.y);
  if (over_missing && tile.from().shadow->shaded() == Verdict::kHidden) return;
  // At the eye's own place nothing hides.
  const double found = cells.seen[view.cell], seen = std::isinf(found) ? ends.lowest[view.cell] : found;
  const double ground = cells.ground[view.cell], wanted = ends.wanted[view.cell];
  const double height = seen <= ground ? 0 : (seen - ground) * tile.resolution();
  double& least = (over_missing ? open_ : least_)[view.cell];
  least = std::min(least, height);
  if (wanted >= ends.lowest[view.cell] && wanted <= highest.z && seen <= wanted)
    verdicts().add(view.cell, over_missing ? Verdict::kUndecided : Verdict::kVisible);
}

void LeastHeightObservation::store_row(const StoredRow& row, Result& result) const {
  row.for_each([&](std::size_t cell, std::size_t place) {
    const double least = least_[cell];
    const bool known = !std::isinf(least) && least <= open_[cell];
    result.get<LeastHeights>().height_m[place] =
        known ? static_cast<float>(least) : std::numeric_limits<float>::quiet_NaN();
  });
}

}  // namespace itin::viewshed
