// Ground behind voids, by sectors of the horizon and by looking at every edge.
#include "request/void_shadow.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "bounds/boundary.hpp"
#include "support/delaunay_tin.hpp"
#include "support/seed.hpp"
#include "support/terrain_tin.hpp"

namespace itin::viewshed {
namespace {

/// Whether a line that left the surface returns to it across the edge. Leaving alone hides nothing.
bool crossed_back(const Tin& tin, const BoundaryEdge& edge, const Point3& from, const Point3& to) {
  const GridPoint &a = tin.vertices[edge.from], &b = tin.vertices[edge.to];
  const auto side_of_edge = [&](const Point3& p) {
    return (double{1} * b.x - a.x) * (p.y - a.y) - (double{1} * b.y - a.y) * (p.x - a.x);
  };
  const auto side_of_line = [&](const GridPoint& p) {
    return (to.x - from.x) * (p.y - from.y) - (to.y - from.y) * (p.x - from.x);
  };
  return side_of_edge(from) < 0 && side_of_edge(to) > 0 && (side_of_line(a) < 0) != (side_of_line(b) < 0);
}

TEST(VoidShadow, IsWhereSomeEdgeIsCrossedBack) {
  std::mt19937 random(test::seed());
  std::uniform_real_distribution<double> share(-0.2, 1.2);
  int shaded = 0, clear = 0;
  for (int i = 0; i < 5; ++i) {
    const Tin tin = test::random_tin(random, 200, 0.2, {{500000, 4000000}, 0.01}, 50000);
    const std::vector<BoundaryEdge> boundary = boundary_edges(tin);
    const auto place = [&] { return Point3{share(random) * 50000, share(random) * 50000, 0}; };
    // On a vertex, too, where edges end.
    const GridPoint& v = tin.vertices[random() % tin.vertices.size()];
    for (const Point3& eye : {place(), place(), Point3{double{1} * v.x, double{1} * v.y, 0}}) {
      const VoidShadow shadow(rim_of(tin, boundary), eye);
      for (int k = 0; k < 300; ++k) {
        const Point3 target = place();
        const bool expected = std::any_of(boundary.begin(), boundary.end(), [&](const BoundaryEdge& edge) {
          return crossed_back(tin, edge, eye, target);
        });
        EXPECT_EQ(shadow.holds(target.x, target.y), expected) << target.x << ", " << target.y;
        ++(expected ? shaded : clear);
      }
    }
  }
  EXPECT_GT(shaded, 100);
  EXPECT_GT(clear, 100);
}

/// A coarse lattice with posts missing, so that rims run along its lines and diagonals.
Tin holed_lattice(std::mt19937& random) {
  const auto height = [&](auto c, auto r) { return c + r > 2 && random() % 5 == 0 ? std::nan("") : 0.0; };
  return test::lattice_tin(9, 9, 4, height, 1, {0, 0});
}

bool on_surface(const Tin& tin, Point2 p) {
  return std::any_of(tin.triangles.begin(), tin.triangles.end(), [&](const Triangle& t) {
    for (std::size_t i = 0; i < 3; ++i) {
      const GridPoint &a = tin.vertices[t[i]], &b = tin.vertices[t[(i + 1) % 3]];
      const double side = (double{1} * b.x - a.x) * (p.y - a.y) - (double{1} * b.y - a.y) * (p.x - a.x);
      if (side < -1e-9) return false;
    }
    return true;
  });
}

/// By the pieces of the line between the lattice's lines and diagonals.
bool leaves_surface(const Tin& tin, Point2 from, Point2 to) {
  std::vector<double> cuts{0, 1};
  const double dx = to.x - from.x, dy = to.y - from.y;
  const auto cut = [&](double at, double by, double size) {
    if (by == 0) return;
    for (int k = -20; k <= 20; ++k)
      if (const double s = (size * k - at) / by; s > 0 && s < 1) cuts.push_back(s);
  };
  cut(from.x, dx, 4), cut(from.y, dy, 4), cut(from.x + from.y, dx + dy, 4), cut(from.x - from.y, dx - dy, 4);
  std::sort(cuts.begin(), cuts.end());
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
    const double s = (cuts[i] + cuts[i + 1]) / 2;
    if (cuts[i + 1] - cuts[i] > 1e-9 && !on_surface(tin, {from.x + s * dx, from.y + s * dy})) return true;
  }
  return false;
}

TEST(VoidShadow, OnTheRimTellsFromWhichSideALineComes) {
  std::mt19937 random(test::seed());
  int shaded = 0, clear = 0;
  for (int i = 0; i < 10; ++i) {
    const Tin tin = holed_lattice(random);
    const std::vector<BoundaryEdge> boundary = boundary_edges(tin);
    const auto place = [&] {  // often on a vertex, an edge or the middle of a square
      Point2 p;
      do {
        p = {static_cast<double>(random() % 33), static_cast<double>(random() % 33)};
      } while (!on_surface(tin, p));
      return p;
    };
    for (int e = 0; e < 20; ++e) {
      const Point2 eye = place();
      const VoidShadow shadow(rim_of(tin, boundary), {eye.x, eye.y, 0});
      for (int k = 0; k < 50; ++k) {
        const Point2 target = place();
        if (target.x == eye.x && target.y == eye.y) continue;
        const bool expected = leaves_surface(tin, eye, target);
        EXPECT_EQ(shadow.holds(target.x, target.y), expected)
            << eye.x << ", " << eye.y << " to " << target.x << ", " << target.y;
        ++(expected ? shaded : clear);
      }
    }
  }
  EXPECT_GT(shaded, 1000);
  EXPECT_GT(clear, 1000);
}

}  // namespace
}  // namespace itin::viewshed
