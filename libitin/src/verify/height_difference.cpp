#include "verify/height_difference.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <itin/box_of.hpp>

namespace itin {

namespace {

using Real = long double;

struct RealPoint {
  Real x, y;
};

/// A convex polygon. A triangle cut by a box and a triangle has at most ten corners.
struct Polygon {
  std::array<RealPoint, 16> corners;
  std::size_t count = 0;

  /// Keeps the part where side(p), which is affine, is not negative.
  template <class Side>
  void cut(const Side& side) {
    const Polygon whole = *this;
    count = 0;
    for (std::size_t i = 0; i < whole.count; ++i) {
      const RealPoint &p = whole.corners[i], &q = whole.corners[i + 1 == whole.count ? 0 : i + 1];
      const Real at_p = side(p), at_q = side(q);
      if (at_p >= 0) corners[count++] = p;
      if ((at_p < 0) == (at_q < 0) || count == corners.size()) continue;
      const Real share = at_p / (at_p - at_q);
      corners[count++] = {p.x + share * (q.x - p.x), p.y + share * (q.y - p.y)};
    }
  }
};

/// A triangle's corners about an origin, and the plane through them.
class Facet {
 public:
  Facet(const RegionMesh& mesh, std::uint32_t triangle, Position origin) {
    for (std::size_t i = 0; i < 3; ++i) {
      const GridPoint& p = mesh.vertices[mesh.mesh.triangles[triangle][i]].point;
      corners_[i] = {static_cast<Real>(std::int64_t{p.x} - origin.x), static_cast<Real>(std::int64_t{p.y} - origin.y)};
      heights_[i] = static_cast<Real>(p.z);
    }
    const auto& [a, b, c] = corners_;
    const Real area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    const Real rise_b = heights_[1] - heights_[0], rise_c = heights_[2] - heights_[0];
    east_ = (rise_b * (c.y - a.y) - rise_c * (b.y - a.y)) / area;
    north_ = (rise_c * (b.x - a.x) - rise_b * (c.x - a.x)) / area;
  }

  Real height(const RealPoint& p) const {
    return heights_[0] + east_ * (p.x - corners_[0].x) + north_ * (p.y - corners_[0].y);
  }
  Polygon polygon() const { return {{corners_[0], corners_[1], corners_[2]}, 3}; }
  void cut(Polygon& polygon) const {
    for (std::size_t i = 0; i < 3; ++i) {
      const RealPoint &p = corners_[i], &q = corners_[(i + 1) % 3];
      polygon.cut([&](const RealPoint& r) { return (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x); });
    }
  }

 private:
  std::array<RealPoint, 3> corners_;  ///< counterclockwise
  std::array<Real, 3> heights_;
  Real east_, north_;  ///< slopes
};

void cut(Polygon& polygon, const GridBox& box, Position origin) {
  const auto x = [&](std::int32_t v) { return static_cast<Real>(std::int64_t{v} - origin.x); };
  const auto y = [&](std::int32_t v) { return static_cast<Real>(std::int64_t{v} - origin.y); };
  polygon.cut([&](const RealPoint& p) { return p.x - x(box.xmin); });
  polygon.cut([&](const RealPoint& p) { return x(box.xmax) - p.x; });
  polygon.cut([&](const RealPoint& p) { return p.y - y(box.ymin); });
  polygon.cut([&](const RealPoint& p) { return y(box.ymax) - p.y; });
}

}  // namespace

HeightDifference::HeightDifference(const RegionMesh& low)
    : low_(low), bounds_(box_of(low.vertices, &SelectedVertex::point)) {
  const auto count = static_cast<std::uint32_t>(low.mesh.triangles.size());
  if (count == 0) return;
  // There are about as many buckets as triangles.
  const double width = 1.0 + bounds_.xmax - bounds_.xmin, height = 1.0 + bounds_.ymax - bounds_.ymin;
  side_ = static_cast<std::int64_t>(
      std::ceil(std::max({std::sqrt(width * height / count), width / count, height / count})));
  columns_ = column(bounds_.xmax) + 1;
  triangles_ = {static_cast<std::size_t>(columns_ * (row(bounds_.ymax) + 1)), count,
                [&](std::uint32_t t, const auto& add) {
                  const GridBox box = low_.box_of_triangle(t);
                  for (std::int64_t r = row(box.ymin); r <= row(box.ymax); ++r)
                    for (std::int64_t c = column(box.xmin); c <= column(box.xmax); ++c) add(bucket(c, r));
                }};
}

template <class Visit>
void HeightDifference::for_each_near(const GridBox& box, const Visit& visit) const {
  const GridBox common = intersection(box, bounds_);
  if (common.empty()) return;
  for (std::int64_t r = row(common.ymin); r <= row(common.ymax); ++r) {
    for (std::int64_t c = column(common.xmin); c <= column(common.xmax); ++c) {
      for (const std::uint32_t t : triangles_.in(bucket(c, r))) {
        const GridBox shared = intersection(common, low_.box_of_triangle(t));
        // A triangle is visited in the first of the buckets that both boxes meet.
        if (!shared.empty() && row(shared.ymin) == r && column(shared.xmin) == c) visit(t);
      }
    }
  }
}

void HeightDifference::add(const RegionMesh& high, std::uint32_t triangle, const GridBox& box,
                           Extremes& extremes) const {
  const Position origin = high.vertices[high.mesh.triangles[triangle][0]].position();
  const Facet upper(high, triangle, origin);
  Polygon within = upper.polygon();
  cut(within, box, origin);
  if (within.count == 0) return;
  for_each_near(intersection(box, high.box_of_triangle(triangle)), [&](std::uint32_t t) {
    const Facet lower(low_, t, origin);
    Polygon shared = within;
    lower.cut(shared);
    for (std::size_t i = 0; i < shared.count; ++i) {
      const RealPoint& p = shared.corners[i];
      extremes.add(static_cast<double>(upper.height(p) - lower.height(p)),
                   {static_cast<double>(origin.x + p.x), static_cast<double>(origin.y + p.y)});
    }
  });
}

}  // namespace itin
