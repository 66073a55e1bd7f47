#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include <fmt/format.h>

#include <itin/feature_at.hpp>
#include <itin/segment_distance.hpp>
#include <itin/store.hpp>

#include "features/footprint_extent.hpp"
#include "store/feature_table.hpp"
#include "store/footprint_codec.hpp"

namespace itin {

namespace {

Point2 in_plan(const Point2& p) {
  return p;
}
Point2 in_plan(const Point3& p) {
  return {p.x, p.y};
}

/// How near a place is to rings, read by the even-odd rule.
class Nearness {
 public:
  explicit Nearness(Point2 place) : place_(place) {}

  template <class Ring>
  void consider(const Ring& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Point2 a = in_plan(ring[i]), b = in_plan(ring[(i + 1) % ring.size()]);
      const Point2 way = way_from_segment(place_, a, b);
      squared_ = std::min(squared_, way.x * way.x + way.y * way.y);
      if ((a.y > place_.y) != (b.y > place_.y) && place_.x < a.x + (place_.y - a.y) / (b.y - a.y) * (b.x - a.x)) {
        inside_ = !inside_;
      }
    }
  }

  /// The distance in metres; 0 inside.
  double distance() const { return inside_ ? 0 : std::sqrt(squared_); }

 private:
  Point2 place_;
  bool inside_ = false;
  double squared_ = std::numeric_limits<double>::infinity();
};

double distance_to(const FootprintFeature& feature, Point2 place) {
  Nearness plan(place);
  for (const PlanRing& ring : feature.rings) plan.consider(ring);
  double distance = plan.distance();
  for (const RoofSurface& surface : feature.surfaces) {
    Nearness roof(place);
    for (const auto& ring : surface.rings) roof.consider(ring);
    distance = std::min(distance, roof.distance());
  }
  return distance;
}

/// Returns the numbers of places from west to east, so that a footprint is compared with few of them.
std::vector<std::size_t> from_west(const std::vector<Point2>& places) {
  std::vector<std::size_t> order(places.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) { return places[i].x < places[j].x; });
  return order;
}

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
  const std::vector<std::size_t> order = from_west(places);
  const ThemeInfo& info = store.metadata().themes[theme - std::size_t{1}];
  for_each_footprint(store, theme, [&](std::int64_t number, const StoredFootprint& footprint) {
    progress.throw_if_cancelled();
    if (info.leaves_out(number)) return;
    const Box box = extent_of(footprint.feature);
    auto i = std::lower_bound(order.begin(), order.end(), box.xmin - kBesideFootprint,
                              [&](std::size_t place, double x) { return places[place].x < x; });
    for (; i != order.end() && places[*i].x <= box.xmax + kBesideFootprint; ++i) {
      if (places[*i].y < box.ymin - kBesideFootprint || places[*i].y > box.ymax + kBesideFootprint) continue;
      const double distance = distance_to(footprint.feature, places[*i]);
      if (distance < nearest[*i]) nearest[*i] = distance, found[*i] = {number, footprint.feature.name, {}};
    }
  });
  add_ids(store, theme, found);
  return found;
}

std::vector<std::optional<FeatureAt>> features_numbered(const Store& store, std::uint16_t theme,
                                                        const std::vector<std::int64_t>& numbers) {
  const std::uint32_t blocks = store.metadata().themes[theme - std::size_t{1}].footprint_blocks;
  std::map<std::uint32_t, std::vector<std::size_t>> wanted;  // places among the numbers, by block
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const std::uint64_t block = static_cast<std::uint64_t>(numbers[i]) / kFootprintsInBlock;
    if (numbers[i] >= 0 && block < blocks) wanted[static_cast<std::uint32_t>(block)].push_back(i);
  }
  std::vector<std::optional<FeatureAt>> found(numbers.size());
  for (const auto& [block, places] : wanted) {
    const std::vector<StoredFootprint> footprints = stored_footprints(store, theme, block);
    for (const std::size_t i : places) {
      const std::size_t place = static_cast<std::size_t>(numbers[i]) % kFootprintsInBlock;
      if (place < footprints.size()) found[i] = {numbers[i], footprints[place].feature.name, {}};
    }
  }
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
