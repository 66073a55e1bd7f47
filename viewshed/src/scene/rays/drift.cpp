#include "scene/rays/drift.hpp"

#include <algorithm>
#include <cmath>

#include <itin/parallel.hpp>

#include "scene/rays/embree.hpp"

namespace itin::viewshed {

namespace {

/// How far rays in single precision run sideways between eyes, metres, and places of a surface.
class Drift {
 public:
  Drift(const std::vector<Point2>& eyes, const Tin& tin) : resolution_(tin.grid.resolution), bounds_(tin.bounds()) {
    for (const Point2& eye : eyes) eyes_.extend(eye);
  }

  /// delta(l), grid units, of the longest line to a place of this part.
  double within(const Box& part) const {
    const double farthest = std::hypot(std::max(part.xmax - eyes_.xmin, eyes_.xmax - part.xmin),
                                       std::max(part.ymax - eyes_.ymin, eyes_.ymax - part.ymin));
    const double half = std::max(bounds_.width(), bounds_.height()) / 2;
    return rounding_error(half / resolution_, farthest / resolution_ + 1);
  }
  double greatest() const { return within(bounds_); }

 private:
  double resolution_;
  Box bounds_;  ///< about the surface
  Box eyes_;
};

}  // namespace

double slope_of(const GridPoint& a, const GridPoint& b, const GridPoint& c) {
  const double ux = double{1} * b.x - a.x, uy = double{1} * b.y - a.y, uz = double{1} * b.z - a.z;
  const double vx = double{1} * c.x - a.x, vy = double{1} * c.y - a.y, vz = double{1} * c.z - a.z;
  const double area = ux * vy - uy * vx;
  return std::hypot(uy * vz - uz * vy, uz * vx - ux * vz) / area;
}

double greatest_drift(const std::vector<Point2>& eyes, const Tin& tin) {
  return eyes.empty() || tin.vertices.empty() ? 0 : Drift(eyes, tin).greatest();
}

void raise_against_drift(const std::vector<Point2>& eyes, Tin& tin) {
  if (eyes.empty()) return;
  std::vector<float> slope(tin.vertices.size());
  for (const Triangle& t : tin.triangles) {
    const auto s = static_cast<float>(slope_of(tin.vertices[t[0]], tin.vertices[t[1]], tin.vertices[t[2]]));
    for (const std::uint32_t v : t) slope[v] = std::max(slope[v], s);
  }
  const Drift drift(eyes, tin);
  const auto raise = [&](std::size_t v) {
    const Point3 p = tin.point(static_cast<std::uint32_t>(v));
    const double by = 2 * drift.within({p.x, p.y, p.x, p.y}) * static_cast<double>(slope[v]);
    tin.vertices[v].z += static_cast<std::int32_t>(std::ceil(by));
  };
  constexpr std::size_t kVerticesPerStep = 1 << 12;
  parallel_for((tin.vertices.size() + kVerticesPerStep - 1) / kVerticesPerStep, [&](std::size_t step) {
    const std::size_t end = std::min(tin.vertices.size(), (step + 1) * kVerticesPerStep);
    for (std::size_t v = step * kVerticesPerStep; v < end; ++v) raise(v);
  });
}

}  // namespace itin::viewshed
