#include "modes/blocker_observation.hpp"

#include <algorithm>
#include <cmath>

#include <itin/sort_unique.hpp>

#include "line/infinity.hpp"

namespace itin::viewshed {

namespace {

/// Tells whether the line crosses ground without data before it comes to this fraction of its length.
bool is_behind_missing_ground(const TileView& tile, const Sight& sight, double at) {
  return tile.crosses_void(std::lerp(sight.from.x, sight.to.x, at), std::lerp(sight.from.y, sight.to.y, at));
}

}  // namespace

BlockerObservation::BlockerObservation(BlockerTable& table) : table_(table) {
  squared_.fill(kInfinity);
  observer_.fill(0);
  blocker_.fill(kNoBlocker);
}

std::uint64_t BlockerObservation::observe(const TileView& tile) {
  found_.clear();
  const std::uint64_t lines = Observation::observe(tile);
  std::vector<std::uint32_t> triangles;
  for (const std::size_t cell : found_) triangles.push_back(blocker_[cell]);
  sort_unique(triangles);
  std::vector<BlockingTriangle> corners;
  for (const std::uint32_t t : triangles) {
    const Triangle& triangle = tile.studies->tin.triangles[t];
    corners.push_back({tile.studies->tin.corners(t), tile.studies->tin.theme(triangle)});
  }
  const std::vector<std::uint32_t> numbers = table_.numbers_of(corners);
  for (const std::size_t cell : found_) {
    const auto at = std::lower_bound(triangles.begin(), triangles.end(), blocker_[cell]) - triangles.begin();
    blocker_[cell] = numbers[static_cast<std::size_t>(at)];
  }
  return lines;
}

void BlockerObservation::study(const TileView& tile, const CellView& view, const Sight& sight) {
  if (sight.verdict != Verdict::kHidden) return;
  const double squared = view.squared_distance();
  const bool nearer =
      squared < squared_[view.cell] || (squared == squared_[view.cell] && view.observer < observer_[view.cell]);
  if (!nearer) return;
  const auto blocker = tile.studies->blockers->find(sight.from, sight.to);
  squared_[view.cell] = squared;
  observer_[view.cell] = view.observer;
  if (!blocker || is_behind_missing_ground(tile, sight, blocker->at)) {
    blocker_[view.cell] = kMissingGround;
  } else {
    blocker_[view.cell] = blocker->triangle;
    found_.push_back(view.cell);
  }
}

void BlockerObservation::store_row(const StoredRow& row, Result& result) const {
  row.for_each([&](std::size_t cell, std::size_t place) {
    result.get<Blockers>().triangle[place] = verdicts()[cell] == Verdict::kHidden ? blocker_[cell] : kNoBlocker;
  });
}

}  // namespace itin::viewshed
