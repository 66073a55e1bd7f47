#include "features/ranked_features.hpp"

#include <algorithm>
#include <cmath>

#include "features/footprint_extent.hpp"
#include "features/mesh/prepare_feature.hpp"
#include "features/mesh/terrain_heights.hpp"
#include "geometry/window_over.hpp"
#include "store/segments/footprint_codec.hpp"
#include "triangulate/selected_tin.hpp"

namespace itin {

namespace {

/// Tells whether a plan covers a position or one beside it: outlines are rounded where they are cut at each other.
bool touches(const MaskIndex& plan, const Position& p) {
  for (const std::int32_t dx : {0, -1, 1})
    for (const std::int32_t dy : {0, -1, 1})
      if (plan.at({p.x + dx, p.y + dy})) return true;
  return false;
}

}  // namespace

std::vector<Box> boxes_beside(const Store& store, std::uint16_t theme, const std::vector<std::int64_t>& numbers) {
  std::vector<Box> boxes;
  for_each_footprint_numbered(store, theme, numbers, [&](std::size_t, const StoredFootprint& footprint) {
    const Box box = extent_of(footprint.feature);
    boxes.push_back({box.xmin - kBesideFootprint, box.ymin - kBesideFootprint, box.xmax + kBesideFootprint,
                     box.ymax + kBesideFootprint});
  });
  return boxes;
}

RankedFeatures::RankedFeatures(const Store& store, std::uint16_t theme, const std::vector<std::int64_t>& numbers,
                               Progress& progress) {
  if (numbers.empty()) return;
  const StoreMetadata& metadata = store.metadata();
  const Selection all = selection_of(metadata, Detail::tolerance(0), ThemeChoice::all());
  const Tin ground = triangulate_selected(store, window_over(boxes_beside(store, theme, numbers)),
                                          all.with_raised_alone(metadata, 0), progress);
  const TerrainHeights terrain(ground);
  FeatureOptions options;
  options.grid = metadata.grid;
  for_each_footprint_numbered(store, theme, numbers, [&](std::size_t i, const StoredFootprint& footprint) {
    progress.throw_if_cancelled();
    const Preparation prepared = prepare(footprint.feature, 0, options, &terrain);
    for (const Patch& patch : prepared.feature.patches)
      patches_[numbers[i]].push_back({MaskIndex(patch.plan), patch.rank});
  });
}

std::int64_t RankedFeatures::owner(const Position& vertex, const std::vector<std::int64_t>& numbers) const {
  return *std::max_element(numbers.begin(), numbers.end(),
                           [&](std::int64_t a, std::int64_t b) { return rank_at(vertex, a) < rank_at(vertex, b); });
}

double RankedFeatures::rank_at(const Position& p, std::int64_t number) const {
  const auto patches = patches_.find(number);
  if (patches == patches_.end()) return -INFINITY;
  double rank = -INFINITY;
  for (const RankedPatch& patch : patches->second)
    if (patch.rank > rank && (patches->second.size() == 1 || touches(patch.plan, p))) rank = patch.rank;
  return rank;
}

}  // namespace itin
