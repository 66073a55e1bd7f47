// The boundary of a Tin against the sides of all its triangles, counted.
#include "bounds/boundary.hpp"

#include <algorithm>
#include <map>
#include <random>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "support/delaunay_tin.hpp"
#include "support/seed.hpp"

namespace itin::viewshed {
namespace {

using Edge = std::pair<std::uint32_t, std::uint32_t>;

std::vector<BoundaryEdge> sides_of_one_triangle(const Tin& tin) {
  const auto for_each_side = [&](const auto& visit) {
    for (std::uint32_t t = 0; t < tin.triangles.size(); ++t)
      for (std::size_t i = 0; i < 3; ++i) visit(tin.triangles[t][i], tin.triangles[t][(i + 1) % 3], t);
  };
  std::map<Edge, int> triangles;
  for_each_side([&](std::uint32_t a, std::uint32_t b, std::uint32_t) { ++triangles[std::minmax(a, b)]; });
  std::vector<BoundaryEdge> edges;
  for_each_side([&](std::uint32_t a, std::uint32_t b, std::uint32_t t) {
    if (triangles.at(std::minmax(a, b)) == 1) edges.push_back({a, b, t});
  });
  return edges;
}

void expect_boundary(const Tin& tin) {
  const std::vector<BoundaryEdge> found = boundary_edges(tin), expected = sides_of_one_triangle(tin);
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_EQ(std::pair(found[i].from, found[i].to), std::pair(expected[i].from, expected[i].to));
    EXPECT_EQ(found[i].triangle, expected[i].triangle);
  }
}

TEST(Boundary, IsEverySideOfOneTriangle) {
  std::mt19937 random(test::seed());
  for (const double holes : {0.0, 0.1, 0.5, 0.95}) {
    expect_boundary(test::random_tin(random, 300, holes));
    expect_boundary(test::random_tin(random, 12000, holes));
  }
}

TEST(Boundary, OfTrianglesThatShareACornerAlone) {
  const Grid grid{{0, 0}, 0.01};
  const std::vector<GridPoint> points = {{0, 0, 0}, {10, 2, 0}, {10, 12, 0}, {-10, -2, 0}, {-10, -12, 0}};
  const Tin tin = test::canonical_tin(grid, points, {0, 0, 0, 0, 0}, {{0, 1, 2}, {0, 3, 4}});
  EXPECT_EQ(boundary_edges(tin).size(), 6u);
  expect_boundary(tin);
}

TEST(Boundary, OfAFanOfManyTriangles) {
  std::vector<GridPoint> points = {{0, 0, 0}};
  std::vector<Triangle> triangles;
  for (std::int32_t i = 0; i < 1000; ++i) points.push_back({1000000 - i * i, 1000 * i, 0});
  for (std::uint32_t i = 1; i < 1000; ++i) triangles.push_back({0, i, i + 1});
  const Tin tin = test::canonical_tin({{0, 0}, 0.01}, points, std::vector<std::uint16_t>(points.size()), triangles);
  EXPECT_EQ(boundary_edges(tin).size(), 1001u);
  expect_boundary(tin);
}

TEST(Boundary, OfNothingIsNothing) {
  EXPECT_TRUE(boundary_edges(Tin{}).empty());
}

}  // namespace
}  // namespace itin::viewshed
