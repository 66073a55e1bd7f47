#include "modes/blocked_features.hpp"

#include <algorithm>
#include <map>

#include <itin/feature_at.hpp>

namespace itin::viewshed {

namespace {

Point2 middle(const Tin& tin, std::uint32_t triangle) {
  const Triangle& t = tin.triangles[triangle];
  const Point3 a = tin.point(t[0]), b = tin.point(t[1]), c = tin.point(t[2]);
  return {(a.x + b.x + c.x) / 3, (a.y + b.y + c.y) / 3};
}

/// The triangles that hide some cell, each once, by their themes.
std::map<std::uint16_t, std::vector<std::uint32_t>> blocking_triangles(const Result& result) {
  std::map<std::uint16_t, std::vector<std::uint32_t>> triangles;
  for (std::size_t i = 0; i < result.blocker.size(); ++i) {
    const std::uint32_t theme = result.blocker_theme[i];
    if (theme != 0 && theme != kNoBlocker && theme != kMissingGround)
      triangles[static_cast<std::uint16_t>(theme)].push_back(result.blocker[i]);
  }
  for (auto& [theme, some] : triangles) {
    std::sort(some.begin(), some.end());
    some.erase(std::unique(some.begin(), some.end()), some.end());
  }
  return triangles;
}

}  // namespace

void find_blocking_features(const Store& store, const Tin& tin, Result& result) {
  std::map<std::uint32_t, std::uint32_t> feature_of;
  for (const auto& [theme, triangles] : blocking_triangles(result)) {
    std::vector<Point2> places;
    for (const std::uint32_t t : triangles) places.push_back(middle(tin, t));
    const auto found = features_at(store, theme, places);
    for (std::size_t i = 0; i < found.size(); ++i)
      if (found[i]) feature_of[triangles[i]] = static_cast<std::uint32_t>(found[i]->number);
  }
  result.blocker_feature.resize(result.blocker.size());
  std::transform(result.blocker.begin(), result.blocker.end(), result.blocker_feature.begin(), [&](std::uint32_t b) {
    const auto feature = feature_of.find(b);
    return feature == feature_of.end() ? kNoBlocker : feature->second;
  });
}

}  // namespace itin::viewshed
