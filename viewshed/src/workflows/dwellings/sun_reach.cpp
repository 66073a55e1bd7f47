#include "workflows/dwellings/sun_reach.hpp"

#include <algorithm>
#include <cmath>

#include <itin/degrees.hpp>
#include <itin/level_choice.hpp>
#include <itin/triangulate.hpp>

#include "line/infinity.hpp"

namespace itin::viewshed {

namespace {

/// The distances between the places of two boxes.
struct BoxDistance {
  double least, greatest;
};

BoxDistance distance_between(const Box& a, const Box& b) {
  const auto gap = [](double low, double high, double other_low, double other_high) {
    return std::max({0.0, other_low - high, low - other_high});
  };
  const auto span = [](double low, double high, double other_low, double other_high) {
    return std::max(high, other_high) - std::min(low, other_low);
  };
  return {std::hypot(gap(a.xmin, a.xmax, b.xmin, b.xmax), gap(a.ymin, a.ymax, b.ymin, b.ymax)),
          std::hypot(span(a.xmin, a.xmax, b.xmin, b.xmax), span(a.ymin, a.ymax, b.ymin, b.ymax))};
}

}  // namespace

SunReach sun_reach(const Store& store, const ThemeChoice& themes, const Earth& earth, const EyesInSun& eyes,
                   Progress& progress) {
  const StoreMetadata& metadata = store.metadata();
  const Box all = metadata.grid.box(metadata.bounds);
  const int level = static_cast<int>(metadata.levels.size()) - 1;
  const Tin coarse = triangulate(store, Window::box(all), detail_of(metadata, level), progress);
  const auto error = store.certified_error(level, all);
  const double above = (error ? error->hi : 0) + store.greatest_feature_height(themes, all);
  const double slope = std::tan(in_radians(eyes.least_elevation_deg));
  SunReach reach{0, eyes.lowest_m};
  for (std::uint32_t t = 0; t < coarse.triangles.size(); ++t) {
    Box box;
    double top = -kInfinity;
    for (const GridPoint& corner : coarse.corners(t)) {
      const Point3 p = metadata.grid.point(corner);
      box.extend(Point2{p.x, p.y}), top = std::max(top, p.z + above);
    }
    const BoxDistance distance = distance_between(eyes.box, box);
    const double rise = top - eyes.lowest_m - earth.drop(distance.least);
    if (rise <= distance.least * slope) continue;
    reach.metres = std::max(reach.metres, std::min(distance.greatest, rise / slope));
    reach.top_m = std::max(reach.top_m, top);
  }
  return reach;
}

}  // namespace itin::viewshed
