#include "modes/feature_names.hpp"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <itin/feature_at.hpp>

namespace itin::viewshed {

namespace {

Point2 middle(const Grid& grid, const std::array<GridPoint, 3>& corners) {
  Point2 sum;
  for (const GridPoint& corner : corners) {
    const Point3 p = grid.point(corner);
    sum.x += p.x, sum.y += p.y;
  }
  return {sum.x / 3, sum.y / 3};
}

/// Fills Blockers::feature.
void find_blocking_features(const Store& store, Blockers& blockers, const Progress& progress) {
  std::map<std::uint16_t, std::pair<std::vector<std::uint32_t>, std::vector<Point2>>> by_theme;
  for (std::uint32_t i = 0; i < blockers.triangles.size(); ++i) {
    const BlockingTriangle& blocker = blockers.triangles[i];
    if (blocker.theme == 0) continue;
    auto& [numbers, places] = by_theme[blocker.theme];
    numbers.push_back(i);
    places.push_back(middle(store.metadata().grid, blocker.corners));
  }
  std::vector<std::uint32_t> feature_of(blockers.triangles.size(), kNoBlocker);
  for (const auto& [theme, of_theme] : by_theme) {
    const auto found = features_at(store, theme, of_theme.second, progress);
    for (std::size_t i = 0; i < found.size(); ++i)
      if (found[i]) feature_of[of_theme.first[i]] = static_cast<std::uint32_t>(found[i]->number);
  }
  blockers.feature.resize(blockers.triangle.size());
  std::transform(blockers.triangle.begin(), blockers.triangle.end(), blockers.feature.begin(),
                 [&](std::uint32_t b) { return b < kMissingGround ? feature_of[b] : kNoBlocker; });
}

}  // namespace

void name_features(const Store& store, Result& result, const Progress& progress) {
  result.theme_names.clear();
  for (const ThemeInfo& theme : store.metadata().themes) result.theme_names.push_back(theme.name);
  if (auto* const blockers = std::get_if<Blockers>(&result.values)) find_blocking_features(store, *blockers, progress);
}

std::string blocker_name(const Result& result, std::uint32_t theme) {
  if (theme == 0) return "terrain";
  if (theme == kMissingGround)
    return result.request.nodata == NoData::kBlock ? "ground without data" : "unknown: ground without data comes first";
  return theme <= result.theme_names.size() ? result.theme_names[theme - 1] : fmt::format("theme {}", theme);
}

}  // namespace itin::viewshed
