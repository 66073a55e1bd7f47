#include <algorithm>
#include <map>
#include <memory>

#include <fmt/format.h>

#include <itin/call_progress.hpp>
#include <itin/error.hpp>
#include <itin/feature_at.hpp>
#include <itin/sort_unique.hpp>
#include <itin/store.hpp>

#include "features/features_near.hpp"
#include "features/ranked_features.hpp"
#include "geometry/window_over.hpp"
#include "triangulate/omitted_tops.hpp"
#include "triangulate/selected_tin.hpp"

namespace itin {

namespace {

/// The vertices of a theme off outlines, and the features that each may be of: those that it touches, or else the
/// nearest, in ascending order.
struct TopsAndFeatures {
  std::vector<VertexId> vertices;
  std::vector<Position> positions;
  std::vector<FeaturesAbout> features;
};

/// How near, in grid steps, a footprint's vertex is to where it stands: outlines are rounded where they are cut at each
/// other, too.
constexpr double kTouching = 1.5;

TopsAndFeatures tops_in(const Store& store, std::uint16_t theme, const std::vector<Box>& boxes, Progress& progress) {
  const Selection all = selection_of(store.metadata(), Detail::tolerance(0), ThemeChoice::all());
  const Tin tin =
      triangulate_selected(store, window_over(boxes), all.with_raised_alone(store.metadata(), theme), progress);
  TopsAndFeatures tops;
  std::vector<Point2> places;
  for (std::uint32_t v = 0; v < tin.raised_theme.size(); ++v) {
    if (tin.raised_theme[v] != theme) continue;
    tops.vertices.push_back(tin.id(v));
    tops.positions.push_back({tin.vertices[v].x, tin.vertices[v].y});
    places.push_back(tin.grid.position(tin.vertices[v].x, tin.vertices[v].y));
  }
  tops.features.resize(places.size(), {.touching = kTouching * tin.grid.resolution});
  for_each_feature_near(store, theme, places, progress,
                        [&](std::size_t i, std::int64_t number, const FootprintFeature&, double metres) {
                          tops.features[i].consider(number, metres);
                        });
  return tops;
}

/// Finds the vertices of a theme's features with these numbers, off their outlines.
TopsOfTheme tops_of(const Store& store, std::uint16_t theme, const std::vector<std::int64_t>& numbers,
                    Progress& progress) {
  TopsOfTheme omitted{theme, {}, boxes_beside(store, theme, numbers)};
  const TopsAndFeatures tops = tops_in(store, theme, omitted.boxes, progress);
  const auto goes = [&](std::int64_t number) { return std::binary_search(numbers.begin(), numbers.end(), number); };
  const auto is_doubtful = [&](const std::vector<std::int64_t>& features) {
    return std::any_of(features.begin(), features.end(), goes) && !std::all_of(features.begin(), features.end(), goes);
  };
  std::vector<std::int64_t> doubtful;
  for (const FeaturesAbout& about : tops.features)
    if (is_doubtful(about.numbers)) doubtful.insert(doubtful.end(), about.numbers.begin(), about.numbers.end());
  sort_unique(doubtful);
  const RankedFeatures ranked(store, theme, doubtful, progress);
  for (std::size_t i = 0; i < tops.vertices.size(); ++i) {
    const std::vector<std::int64_t>& features = tops.features[i].numbers;
    if (features.empty()) continue;
    const std::int64_t owner = is_doubtful(features) ? ranked.owner(tops.positions[i], features) : features.front();
    if (goes(owner)) omitted.vertices.push_back(tops.vertices[i]);
  }
  std::sort(omitted.vertices.begin(), omitted.vertices.end());
  return omitted;
}

void require_raised(const StoreMetadata& metadata, std::uint16_t theme) {
  if (theme == 0 || theme > metadata.themes.size() || !metadata.themes[theme - std::size_t{1}].is_raised())
    throw InputError(fmt::format("theme {}: has no features that stand on the ground", theme), "without");
}

}  // namespace

ThemeChoice without_features(const Store& store, const ThemeChoice& themes, std::vector<FeatureNumber> features,
                             Progress& progress) {
  if (features.empty()) return themes;
  sort_unique(features);
  std::map<std::uint16_t, std::vector<std::int64_t>> by_theme;
  for (const FeatureNumber& feature : features) by_theme[feature.theme].push_back(feature.number);
  std::vector<OmittedFeature> omitted;
  std::vector<TopsOfTheme> tops;
  CallProgress call(progress);
  for (const auto& [theme, numbers] : by_theme) {
    const double share = 1.0 / static_cast<double>(by_theme.size() - tops.size());
    require_raised(store.metadata(), theme);
    const std::string& name = store.metadata().themes[theme - std::size_t{1}].name;
    const auto known = features_numbered(store, theme, numbers);
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      if (!known[i]) throw InputError(fmt::format("theme '{}': has no feature {}", name, numbers[i]), "without");
      omitted.push_back({theme, numbers[i], name, known[i]->name, known[i]->id});
    }
    tops.push_back(tops_of(store, theme, numbers, call.step(share)));
  }
  call.finish();
  return themes.omitting(std::move(omitted), std::make_shared<const OmittedTops>(std::move(tops)));
}

}  // namespace itin
