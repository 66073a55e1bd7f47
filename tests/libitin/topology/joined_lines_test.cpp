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

Tin with_lines(std::vector<LineEdge> lines) {
  Tin tin;
  tin.vertices.resize(40);
  std::sort(lines.begin(), lines.end());
  lines.erase(std::unique(lines.begin(), lines.end()), lines.end());
  tin.lines = std::move(lines);
  return tin;
}

std::vector<std::vector<std::uint32_t>> joined(const Tin& tin, std::uint16_t theme) {
  std::vector<std::vector<std::uint32_t>> result;
  for (const JoinedLine& line : joined_lines(tin, theme)) result.push_back(line.vertices);
  return result;
}

using Lines = std::vector<std::vector<std::uint32_t>>;

TEST(JoinedLines, GoFromEndToJunction) {
  EXPECT_EQ(joined(with_lines({{1, 5, 1}, {3, 5, 1}, {3, 9, 1}, {2, 3, 1}}), 1), (Lines{{1, 5, 3}, {2, 3}, {3, 9}}));
}

TEST(JoinedLines, CloseRings) {
  EXPECT_EQ(joined(with_lines({{2, 4, 1}, {4, 7, 1}, {2, 7, 1}, {8, 9, 1}}), 1), (Lines{{8, 9}, {2, 4, 7, 2}}));
}

TEST(JoinedLines, ARingAtAJunctionReturnsToIt) {
  EXPECT_EQ(joined(with_lines({{1, 2, 1}, {2, 3, 1}, {3, 4, 1}, {2, 4, 1}}), 1), (Lines{{1, 2}, {2, 3, 4, 2}}));
}

TEST(JoinedLines, AreOfTheirThemeAlone) {
  const Tin tin = with_lines({{1, 2, 1}, {2, 3, 2}, {2, 4, 1}});
  EXPECT_EQ(joined(tin, 1), (Lines{{1, 2, 4}}));
  EXPECT_EQ(joined(tin, 2), (Lines{{2, 3}}));
  EXPECT_TRUE(joined(tin, 3).empty());
}

TEST(JoinedLines, HoldEveryEdgeOnce) {
  std::mt19937 random(test::seed());
  for (int round = 0; round < 300; ++round) {
    std::uniform_int_distribution<std::uint32_t> vertex(0, 14);
    std::vector<LineEdge> edges;
    for (int i = 0; i < 18; ++i) {
      const std::uint32_t a = vertex(random), b = vertex(random);
      if (a != b) edges.push_back({std::min(a, b), std::max(a, b), 1});
    }
    const Tin tin = with_lines(edges);
    std::map<std::uint32_t, int> degree;
    for (const LineEdge& e : tin.lines) ++degree[e.from], ++degree[e.to];
    std::multiset<std::pair<std::uint32_t, std::uint32_t>> found;
    for (const auto& line : joined(tin, 1)) {
      ASSERT_GE(line.size(), 2U);
      for (std::size_t i = 0; i + 1 < line.size(); ++i) found.emplace(std::minmax(line[i], line[i + 1]));
      for (std::size_t i = 1; i + 1 < line.size(); ++i) EXPECT_EQ(degree[line[i]], 2);
      const bool ring = line.front() == line.back();
      EXPECT_TRUE(ring || (degree[line.front()] != 2 && degree[line.back()] != 2));
    }
    std::multiset<std::pair<std::uint32_t, std::uint32_t>> expected;
    for (const LineEdge& e : tin.lines) expected.emplace(e.from, e.to);
    EXPECT_EQ(found, expected);
  }
}

}  // namespace
}  // namespace itin
