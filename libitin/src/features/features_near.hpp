// Which features of a raised theme are near places, and how near.
//
//   for_each_feature_near(store, theme, places, progress,
//                         [&](std::size_t place, std::int64_t number, const FootprintFeature& feature, double metres) {
//                           if (metres == 0) holding[place].push_back(number);
//                         });
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include <itin/geometry.hpp>
#include <itin/progress.hpp>
#include <itin/store.hpp>

#include "features/footprint_extent.hpp"
#include "store/segments/footprint_codec.hpp"

namespace itin {

/// Returns the distance in metres from a place to a feature's footprint on the grid, where the feature stands; 0
/// within.
double distance_to(const FootprintFeature& feature, Point2 place, const Grid& grid);

/// The features that touch a place, or else the one that is nearest to it, in the order of their numbers.
struct FeaturesAbout {
  double touching = 0;                                       ///< metres; what is no farther away touches the place
  double nearest = std::numeric_limits<double>::infinity();  ///< metres; what is no nearer at first does not count
  std::vector<std::int64_t> numbers = {};

  /// Takes a feature at this distance. Features come in the order of their numbers.
  void consider(std::int64_t number, double metres) {
    if (metres > touching && metres >= nearest) return;
    if (nearest > touching) numbers.clear();
    numbers.push_back(number);
    nearest = std::min(nearest, metres);
  }
};

/// Returns the numbers of places from west to east, so that a footprint is compared with few of them.
std::vector<std::size_t> from_west(const std::vector<Point2>& places);

/// Calls visit(place, number, feature, metres) for each place, by its number, and each feature of the theme that stands
/// and is at most kBesideFootprint away from it; features come in the order of their numbers. Cost: reads all
/// footprints of the theme, a block of 256 at a time, about a microsecond each. Throws CorruptStore, Cancelled.
template <class Visit>
void for_each_feature_near(const Store& store, std::uint16_t theme, const std::vector<Point2>& places,
                           const Progress& progress, const Visit& visit) {
  const std::vector<std::size_t> order = from_west(places);
  const StoreMetadata& metadata = store.metadata();
  for_each_footprint(store, theme, [&](std::int64_t number, const StoredFootprint& footprint) {
    progress.throw_if_cancelled();
    if (metadata.themes[theme - std::size_t{1}].leaves_out(number)) return;
    const Box box = extent_of(footprint.feature);
    auto i = std::lower_bound(order.begin(), order.end(), box.xmin - kBesideFootprint,
                              [&](std::size_t place, double x) { return places[place].x < x; });
    for (; i != order.end() && places[*i].x <= box.xmax + kBesideFootprint; ++i) {
      if (places[*i].y < box.ymin - kBesideFootprint || places[*i].y > box.ymax + kBesideFootprint) continue;
      const double metres = distance_to(footprint.feature, places[*i], metadata.grid);
      if (metres <= kBesideFootprint) visit(*i, number, footprint.feature, metres);
    }
  });
}

}  // namespace itin
