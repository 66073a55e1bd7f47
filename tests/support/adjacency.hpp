// What a mesh is, whatever the order of its triangles: which triangles there are, and which are neighbours.
#pragma once

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "triangulate/mesh/delaunay.hpp"

namespace itin::test {

using FlatCorners = std::array<Position, 3>;

inline FlatCorners smallest_first(FlatCorners t) {
  std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  return t;
}

/// Each triangle with its three neighbours, in any order; beyond the hull three equal corners.
inline std::map<FlatCorners, std::multiset<FlatCorners>> adjacency(const PlaneMesh& mesh,
                                                                   const std::vector<Position>& positions) {
  const auto corners = [&](std::uint32_t t) {
    if (t == kNoTriangle) return FlatCorners{};
    const auto& [a, b, c] = mesh.triangles[t];
    return smallest_first({positions[a], positions[b], positions[c]});
  };
  std::map<FlatCorners, std::multiset<FlatCorners>> result;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    std::multiset<FlatCorners>& neighbours = result[corners(t)];
    EXPECT_TRUE(neighbours.empty()) << "a triangle twice";
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t n = mesh.neighbours[t][i];
      neighbours.insert(corners(n));
      // The neighbour shares edge i and knows it.
      if (n == kNoTriangle) continue;
      const auto back = std::find(mesh.neighbours[n].begin(), mesh.neighbours[n].end(), t);
      EXPECT_NE(back, mesh.neighbours[n].end());
      for (std::size_t k = 1; k < 3; ++k)
        EXPECT_NE(std::count(mesh.triangles[n].begin(), mesh.triangles[n].end(), mesh.triangles[t][(i + k) % 3]), 0);
    }
  }
  return result;
}

}  // namespace itin::test
