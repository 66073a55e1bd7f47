#include <fmt/format.h>

#include <itin/feature_at.hpp>
#include <itin/store.hpp>

#include "features/features_near.hpp"
#include "store/feature_table.hpp"
#include "store/segments/footprint_codec.hpp"

namespace itin {

namespace {

void add_ids(const Store& store, std::uint16_t theme, std::vector<std::optional<FeatureAt>>& features) {
  FeatureTable table(store, theme);
  for (std::optional<FeatureAt>& feature : features)
    if (const FeatureRecord* record = feature ? table.at(feature->number) : nullptr) feature->id = record->id;
}

}  // namespace

std::string title_of(const FeatureAt& feature) {
  if (feature.id.empty() || feature.name == feature.id || feature.name == "feature " + feature.id) return feature.name;
  return fmt::format("{} (id {})", feature.name, feature.id);
}

std::vector<std::optional<FeatureAt>> features_at(const Store& store, std::uint16_t theme,
                                                  const std::vector<Point2>& places, const Progress& progress) {
  std::vector<std::optional<FeatureAt>> found(places.size());
  std::vector<double> nearest(places.size(), kBesideFootprint);
  for_each_feature_near(store, theme, places, progress,
                        [&](std::size_t i, std::int64_t number, const FootprintFeature& feature, double distance) {
                          if (distance < nearest[i]) nearest[i] = distance, found[i] = {number, feature.name, {}};
                        });
  add_ids(store, theme, found);
  return found;
}

std::vector<std::optional<FeatureAt>> features_numbered(const Store& store, std::uint16_t theme,
                                                        const std::vector<std::int64_t>& numbers) {
  std::vector<std::optional<FeatureAt>> found(numbers.size());
  for_each_footprint_numbered(store, theme, numbers, [&](std::size_t i, const StoredFootprint& footprint) {
    found[i] = {numbers[i], footprint.feature.name, {}};
  });
  add_ids(store, theme, found);
  return found;
}

std::vector<FeatureAt> features_of(const Store& store, std::uint16_t theme) {
  std::vector<FeatureAt> all;
  FeatureTable table(store, theme);
  for_each_footprint(store, theme, [&](std::int64_t number, const StoredFootprint& footprint) {
    const FeatureRecord* const record = table.at(number);
    all.push_back({number, footprint.feature.name, record != nullptr ? record->id : std::string()});
  });
  return all;
}

}  // namespace itin
