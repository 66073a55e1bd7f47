// Rasters' triangulations told from others, and where they end.
#include "cell_lattice.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "support/delaunay_tin.hpp"
#include "support/seed.hpp"
#include "support/terrain_tin.hpp"

namespace itin::viewshed {
namespace {

using Edge = std::array<std::uint32_t, 3>;

std::vector<Edge> listed(const std::vector<BoundaryEdge>& edges) {
  std::vector<Edge> result;
  for (const BoundaryEdge& e : edges) result.push_back({e.triangle, e.from, e.to});
  return result;
}

/// A lattice with posts left out here and there, and triangles as well.
Tin gappy(std::mt19937& random, double share) {
  std::bernoulli_distribution absent(share);
  Tin tin = test::lattice_tin(23, 17, 25, [&](std::int32_t, std::int32_t) { return absent(random) ? NAN : 1.0; });
  std::erase_if(tin.triangles, [&](const Triangle&) { return absent(random); });
  return tin;
}

TEST(CellLattice, EveryTriangleLiesInItsCell) {
  std::mt19937 random(test::seed());
  for (const double share : {0.0, 0.1}) {
    const Tin tin = gappy(random, share);
    const auto lattice = cell_lattice(tin);
    ASSERT_TRUE(lattice);
    for (std::size_t t = 0; t < tin.triangles.size(); ++t) {
      double x = 0, y = 0;
      for (const std::uint32_t v : tin.triangles[t]) x += tin.point(v).x / 3, y += tin.point(v).y / 3;
      const auto cell = lattice->grid.cell_at({x, y});
      ASSERT_TRUE(cell);
      EXPECT_EQ(lattice->grid.index(*cell), lattice->cell_of[t]);
    }
  }
}

TEST(CellLattice, EndsWhereEdgesHaveNoTwins) {
  std::mt19937 random(test::seed());
  for (const double share : {0.0, 0.02, 0.1, 0.15}) {
    const Tin tin = gappy(random, share);
    const auto lattice = cell_lattice(tin);
    ASSERT_TRUE(lattice);
    EXPECT_EQ(listed(boundary_edges(tin, *lattice)), listed(boundary_edges(tin)));
  }
}

TEST(CellLattice, OtherTinsAreNone) {
  std::mt19937 random(test::seed());
  EXPECT_FALSE(cell_lattice(Tin{}));
  EXPECT_FALSE(cell_lattice(test::random_tin(random, 100, 0)));
  Tin moved = gappy(random, 0);
  ++moved.vertices[random() % moved.vertices.size()].x;
  EXPECT_FALSE(cell_lattice(moved));
  // As wide and as high as a cell, but with a corner amid its side.
  Tin wedge;
  wedge.vertices = {{0, 0, 0}, {10, 0, 0}, {5, 10, 0}};
  wedge.triangles = {{0, 1, 2}};
  EXPECT_FALSE(cell_lattice(wedge));
  // Two far apart: a grid about both would be empty.
  Tin sparse;
  sparse.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5000, 5000, 0}, {5001, 5000, 0}, {5000, 5001, 0}};
  sparse.triangles = {{0, 1, 2}, {3, 4, 5}};
  EXPECT_FALSE(cell_lattice(sparse));
}

}  // namespace
}  // namespace itin::viewshed
