#include "scene/rays/drift.hpp"

#include <algorithm>
#include <cmath>

#include <itin/parallel.hpp>

#include "scene/rays/embree.hpp"

namespace itin::viewshed {

double slope_of(const GridPoint& a, const GridPoint& b, const GridPoint& c) {
  const double ux = double{1} * b.x - a.x, uy = double{1} * b.y - a.y, uz = double{1} * b.z - a.z;
  const double vx = double{1} * c.x - a.x, vy = double{1} * c.y - a.y, vz = double{1} * c.z - a.z;
  const double area = ux * vy - uy * vx;
  return std::hypot(uy * vz - uz * vy, uz * vx - ux * vz) / area;
}

void raise_against_drift(const std::vector<Point2>& eyes, Tin& tin) {
  if (eyes.empty()) return;
  std::vector<float> slope(tin.vertices.size());
  for (const Triangle& t : tin.triangles) {
    const auto s = static_cast<float>(slope_of(tin.vertices[t[0]], tin.vertices[t[1]], tin.vertices[t[2]]));
    for (const std::uint32_t v : t) slope[v] = std::max(slope[v], s);
  }
  const Box box = tin.bounds();
  Box box_of_eyes;
  for (const Point2& eye : eyes) box_of_eyes.extend(eye);
  const double half = std::max(box.width(), box.height()) / 2 / tin.grid.resolution;
  const auto raise = [&](std::size_t v) {
    const Point3 p = tin.point(static_cast<std::uint32_t>(v));
    const double farthest = std::hypot(std::max(std::abs(p.x - box_of_eyes.xmin), std::abs(p.x - box_of_eyes.xmax)),
                                       std::max(std::abs(p.y - box_of_eyes.ymin), std::abs(p.y - box_of_eyes.ymax)));
    const double drift = rounding_error(half, farthest / tin.grid.resolution + 1);
    tin.vertices[v].z += static_cast<std::int32_t>(std::ceil(2 * drift * static_cast<double>(slope[v])));
  };
  constexpr std::size_t kVerticesPerStep = 1 << 12;
  parallel_for((tin.vertices.size() + kVerticesPerStep - 1) / kVerticesPerStep, [&](std::size_t step) {
    const std::size_t end = std::min(tin.vertices.size(), (step + 1) * kVerticesPerStep);
    for (std::size_t v = step * kVerticesPerStep; v < end; ++v) raise(v);
  });
}

}  // namespace itin::viewshed
