#include <algorithm>
#include <map>
#include <memory>

#include <fmt/format.h>

#include <itin/call_progress.hpp>
#include <itin/error.hpp>
#include <itin/feature_at.hpp>
#include <itin/sort_unique.hpp>
#include <itin/store.hpp>

#include "features/footprint_extent.hpp"
#include "store/footprint_codec.hpp"
#include "triangulate/omitted_tops.hpp"
#include "triangulate/selected_tin.hpp"

namespace itin {

namespace {

Box box_beside(const FootprintFeature& feature) {
  const Box box = extent_of(feature);
  return {box.xmin - kBesideFootprint, box.ymin - kBesideFootprint, box.xmax + kBesideFootprint,
          box.ymax + kBesideFootprint};
}

/// Returns the boxes of a theme's features with these numbers, which ascend.
std::vector<Box> boxes_of(const Store& store, std::uint16_t theme, const std::vector<std::int64_t>& numbers) {
  std::vector<Box> boxes;
  std::uint32_t read = 0;
  std::vector<StoredFootprint> footprints;
  for (const std::int64_t number : numbers) {
    const auto block = static_cast<std::uint32_t>(number / std::int64_t{kFootprintsInBlock});
    if (footprints.empty() || block != read) footprints = stored_footprints(store, theme, read = block);
    boxes.push_back(box_beside(footprints[static_cast<std::size_t>(number) % kFootprintsInBlock].feature));
  }
  return boxes;
}

/// The features that a vertex may be of, by number: how high the highest of their triangles about it is, in the mean of
/// its corners.
using Owners = std::map<std::int64_t, double>;

/// Returns the highest of the features about a vertex: where two of them touch, the wall stands in the lower one, and
/// the party line is the other's (footprint_arrangement.hpp). Among equals it is the first one's.
std::int64_t owner_among(const Owners& owners) {
  return std::max_element(owners.begin(), owners.end(),
                          [](const auto& a, const auto& b) { return a.second < b.second; })
      ->first;
}

Point2 middle_of(const Tin& tin, const Triangle& t) {
  const Point3 a = tin.point(t[0]), b = tin.point(t[1]), c = tin.point(t[2]);
  return {(a.x + b.x + c.x) / 3, (a.y + b.y + c.y) / 3};
}

/// Finds the features that each vertex off outlines may be of, by the triangles about it.
std::map<std::uint32_t, Owners> owners_of_tops(const Store& store, const Tin& tin, std::uint16_t theme,
                                               const Progress& progress) {
  std::vector<Triangle> triangles;
  std::vector<Point2> places;
  for (const Triangle& t : tin.triangles) {
    if (tin.theme(t) != theme) continue;
    triangles.push_back(t);
    places.push_back(middle_of(tin, t));
  }
  const auto features = features_at(store, theme, places, progress);
  std::map<std::uint32_t, Owners> owners;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    if (!features[i]) continue;
    const double height =
        double{1} * tin.vertices[triangles[i][0]].z + tin.vertices[triangles[i][1]].z + tin.vertices[triangles[i][2]].z;
    for (const std::uint32_t v : triangles[i]) {
      if (tin.raised_theme[v] != theme) continue;
      double& highest = owners[v].try_emplace(features[i]->number, height).first->second;
      highest = std::max(highest, height);
    }
  }
  return owners;
}

/// Finds the vertices of a theme's features with these numbers, off their outlines.
TopsOfTheme tops_of(const Store& store, std::uint16_t theme, const std::vector<std::int64_t>& numbers,
                    Progress& progress) {
  TopsOfTheme tops{theme, {}, boxes_of(store, theme, numbers)};
  std::vector<Window::Polygon> parts;
  for (const Box& box : tops.boxes) parts.push_back(Window::rectangle(box));
  const Selection all = selection_of(store.metadata(), Detail::tolerance(0), ThemeChoice::all());
  const Tin tin = triangulate_selected(store, Window::polygons(std::move(parts)),
                                       all.with_raised_alone(store.metadata(), theme), progress);
  for (const auto& [vertex, owners] : owners_of_tops(store, tin, theme, progress))
    if (std::binary_search(numbers.begin(), numbers.end(), owner_among(owners)))
      tops.vertices.push_back(tin.id(vertex));
  std::sort(tops.vertices.begin(), tops.vertices.end());
  return tops;
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
