// Lines joined from edges: the same edges, each once, and no line that could go on.
#include "topology/joined_lines.hpp"

#include <algorithm>
#include <map>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include "support/seed.hpp"

namespace itin {
namespace {

using Lines = std::vector<std::vector<std::uint32_t>>;

Lines joined(const std::vector<LineEnds>& edges) {
  Lines result;
  for (const JoinedLine& line : joined_lines(edges)) result.push_back(line.vertices);
  return result;
}

TEST(JoinedLines, GoFromEndToJunction) {
  EXPECT_EQ(joined({{1, 5}, {3, 5}, {3, 9}, {2, 3}}), (Lines{{1, 5, 3}, {2, 3}, {3, 9}}));
}

TEST(JoinedLines, CloseRings) {
  EXPECT_EQ(joined({{2, 4}, {4, 7}, {2, 7}, {8, 9}}), (Lines{{8, 9}, {2, 4, 7, 2}}));
}

TEST(JoinedLines, ARingAtAJunctionReturnsToIt) {
  EXPECT_EQ(joined({{1, 2}, {2, 3}, {3, 4}, {2, 4}}), (Lines{{1, 2}, {2, 3, 4, 2}}));
}

TEST(JoinedLines, TakeEdgesInAnyOrder) {
  const Lines lines{{1, 5, 3}, {2, 3}, {3, 9}};
  std::vector<LineEnds> edges{{1, 5}, {2, 3}, {3, 5}, {3, 9}};
  do EXPECT_EQ(joined(edges), lines);
  while (std::next_permutation(edges.begin(), edges.end()));
  EXPECT_TRUE(joined({}).empty());
}

TEST(JoinedLines, HoldEveryEdgeOnce) {
  std::mt19937 random(test::seed());
  for (int round = 0; round < 300; ++round) {
    std::uniform_int_distribution<std::uint32_t> vertex(0, 14);
    std::set<LineEnds> distinct;
    for (int i = 0; i < 18; ++i) {
      const std::uint32_t a = vertex(random), b = vertex(random);
      if (a != b) distinct.emplace(std::min(a, b), std::max(a, b));
    }
    const std::vector<LineEnds> edges(distinct.begin(), distinct.end());
    std::map<std::uint32_t, int> degree;
    for (const auto& [from, to] : edges) ++degree[from], ++degree[to];
    std::multiset<LineEnds> found;
    for (const auto& line : joined(edges)) {
      ASSERT_GE(line.size(), 2U);
      for (std::size_t i = 0; i + 1 < line.size(); ++i) found.emplace(std::minmax(line[i], line[i + 1]));
      for (std::size_t i = 1; i + 1 < line.size(); ++i) EXPECT_EQ(degree[line[i]], 2);
      const bool ring = line.front() == line.back();
      EXPECT_TRUE(ring || (degree[line.front()] != 2 && degree[line.back()] != 2));
    }
    EXPECT_EQ(found, std::multiset<LineEnds>(edges.begin(), edges.end()));
  }
}

}  // namespace
}  // namespace itin
