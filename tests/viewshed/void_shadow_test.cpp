// What lies behind voids, by sectors of the horizon and by looking at every edge.
#include "void_shadow.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "support/delaunay_tin.hpp"
#include "support/seed.hpp"

namespace itin::viewshed {
namespace {

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
      const VoidShadow shadow(tin, boundary, eye);
      for (int k = 0; k < 300; ++k) {
        const Point3 target = place();
        SightLines line;
        line.start_at(eye);
        line.to_x[0] = target.x, line.to_y[0] = target.y;
        const bool expected = std::any_of(boundary.begin(), boundary.end(), [&](const BoundaryEdge& edge) {
          return crossing_back(tin, edge, line, 0) == Crossing::kBack;
        });
        EXPECT_EQ(shadow.holds(target.x, target.y), expected) << target.x << ", " << target.y;
        ++(expected ? shaded : clear);
      }
    }
  }
  EXPECT_GT(shaded, 100);
  EXPECT_GT(clear, 100);
}

}  // namespace
}  // namespace itin::viewshed
