#include "features/features_near.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <itin/segment_distance.hpp>

namespace itin {

namespace {

/// How near a place is to rings on the grid, where features stand, read by the even-odd rule.
class Nearness {
 public:
  Nearness(Point2 place, const Grid& grid) : place_(place), grid_(grid) {}

  template <class Ring>
  void consider(const Ring& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Point2 a = on_grid(ring[i]), b = on_grid(ring[(i + 1) % ring.size()]);
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
  /// Takes a Point2 or Point3.
  template <class Point>
  Point2 on_grid(const Point& p) const {
    if (!grid_.covers({p.x, p.y})) return {p.x, p.y};
    const GridPoint q = grid_.quantise({p.x, p.y, 0});
    return grid_.position(q.x, q.y);
  }

  Point2 place_;
  const Grid& grid_;
  bool inside_ = false;
  double squared_ = std::numeric_limits<double>::infinity();
};

}  // namespace

double distance_to(const FootprintFeature& feature, Point2 place, const Grid& grid) {
  Nearness plan(place, grid);
  for (const PlanRing& ring : feature.rings) plan.consider(ring);
  double distance = plan.distance();
  for (const RoofSurface& surface : feature.surfaces) {
    Nearness roof(place, grid);
    for (const auto& ring : surface.rings) roof.consider(ring);
    distance = std::min(distance, roof.distance());
  }
  return distance;
}

std::vector<std::size_t> from_west(const std::vector<Point2>& places) {
  std::vector<std::size_t> order(places.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) { return places[i].x < places[j].x; });
  return order;
}

}  // namespace itin
