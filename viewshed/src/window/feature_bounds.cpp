#include "window/feature_bounds.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <itin/parallel.hpp>

#include "bounds/feature_margin.hpp"

namespace itin::viewshed {

namespace {

struct Feature {
  std::int32_t height = 0;  ///< the greatest, grid units; 0 where none stands
  double bend = 0;          ///< how far the ground beside it is bent, grid units
};

Box box_near(const Tin& tin, const Triangle& t) {
  Box box;
  for (const std::uint32_t v : t) {
    const Point3 p = tin.point(v);
    box.extend(Point2{p.x, p.y});
  }
  const double margin = kStepsBeside * tin.grid.resolution;
  return {box.xmin - margin, box.ymin - margin, box.xmax + margin, box.ymax + margin};
}

/// The steepest slope of a triangle: grid units up per grid unit along.
double slope_of(const GridPoint& a, const GridPoint& b, const GridPoint& c) {
  const double ux = double{1} * b.x - a.x, uy = double{1} * b.y - a.y, uz = double{1} * b.z - a.z;
  const double vx = double{1} * c.x - a.x, vy = double{1} * c.y - a.y, vz = double{1} * c.z - a.z;
  const double area = ux * vy - uy * vx;
  return std::hypot(uy * vz - uz * vy, uz * vx - ux * vz) / area;
}

/// The steepest slope of both surfaces that the bounds make of the triangle; heights and distances are grid units.
double steepest(const Tin& tin, const Triangle& t, const std::vector<HeightBounds>& bounds) {
  const auto slope = [&](std::int32_t HeightBounds::*const bound) {
    const auto corner = [&](int i) {
      GridPoint p = tin.vertices[t[i]];
      p.z += bounds[t[i]].*bound;
      return p;
    };
    return slope_of(corner(0), corner(1), corner(2));
  };
  return std::max(slope(&HeightBounds::lo), slope(&HeightBounds::hi));
}

std::vector<Feature> features_in(const Store& store, const ThemeChoice& themes, const Tin& tin,
                                 const std::vector<HeightBounds>& bounds) {
  std::vector<Feature> features(tin.triangles.size());
  constexpr std::size_t kTrianglesPerStep = 1 << 10;
  parallel_for((features.size() + kTrianglesPerStep - 1) / kTrianglesPerStep, [&](std::size_t step) {
    for (std::size_t i = step * kTrianglesPerStep; i < std::min(features.size(), (step + 1) * kTrianglesPerStep); ++i) {
      const Triangle& t = tin.triangles[i];
      const double height = store.greatest_feature_height(themes, box_near(tin, t)) / tin.grid.resolution;
      if (height == 0) continue;
      // The bend is doubled, for the slopes of triangles next to a vertex's own.
      features[i] = {static_cast<std::int32_t>(std::ceil(height)),
                     2 * kStepsBeside * steepest(tin, t, bounds) + kStepsUp};
    }
  });
  return features;
}

}  // namespace

void enclose_features(const Store& store, const ThemeChoice& themes, const Tin& tin,
                      std::vector<HeightBounds>& bounds) {
  const std::vector<Feature> of_triangle = features_in(store, themes, tin, bounds);
  std::vector<Feature> of_vertex(bounds.size());
  for (std::size_t i = 0; i < of_triangle.size(); ++i) {
    for (const std::uint32_t v : tin.triangles[i]) {
      of_vertex[v].height = std::max(of_vertex[v].height, of_triangle[i].height);
      of_vertex[v].bend = std::max(of_vertex[v].bend, of_triangle[i].bend);
    }
  }
  for (std::size_t v = 0; v < bounds.size(); ++v) {
    const auto bend = static_cast<std::int32_t>(std::ceil(of_vertex[v].bend));
    bounds[v].lo -= bend;
    bounds[v].hi += bend + of_vertex[v].height;
  }
}

}  // namespace itin::viewshed
