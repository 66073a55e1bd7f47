#include "store/segments/edge_quadtree.hpp"

#include <algorithm>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include "libitin/store/random_points.hpp"
#include "store/codec/byte_stream.hpp"
#include "support/seed.hpp"

namespace itin {
namespace {

TEST(Crosses, TouchingCounts) {
  const Cell cell{morton(0, 0), 4};  // [0, 16] x [0, 16] with its border
  EXPECT_TRUE(crosses({3, 3, 4, 4}, cell));
  EXPECT_TRUE(crosses({-10, 8, 30, 9}, cell));
  EXPECT_TRUE(crosses({16, -5, 16, 40}, cell));
  EXPECT_TRUE(crosses({-16, 16, 16, -16}, cell));
  EXPECT_TRUE(crosses({16, 16, 20, 20}, cell));
  EXPECT_FALSE(crosses({17, -5, 17, 40}, cell));
  EXPECT_FALSE(crosses({-17, 16, 16, -17}, cell));
  EXPECT_FALSE(crosses({-5, 10, 10, 30}, cell));
}

TEST(EdgeQuadtree, EveryCellListsEverySegmentThatCrossesIt) {
  const auto given = test::random_store(test::seed(), 6000).segments;
  std::set<Segment> seen;
  std::size_t leaves = 0;
  std::uint64_t end = 0;
  for_each_edge_leaf(given, [&](const Cell& cell, const std::vector<Segment>& segments) {
    ++leaves;
    EXPECT_GE(cell.code, end);
    end = cell.end();
    std::vector<Segment> expected;
    for (const Segment& s : given) {
      if (crosses(s, cell)) expected.push_back(s);
    }
    std::sort(expected.begin(), expected.end());
    expected.erase(std::unique(expected.begin(), expected.end()), expected.end());
    EXPECT_EQ(segments, expected);
    EXPECT_TRUE(segments.size() <= kEdgeLeafCapacity || cell.log2_side == kMinEdgeLeafLog2Side);
    EXPECT_EQ(decode_outline(cell, segments.size(), encode_outline(cell, segments)), segments);
    EXPECT_THROW(decode_outline(cell, segments.size() + 1, encode_outline(cell, segments)), DecodeError);
    seen.insert(segments.begin(), segments.end());
  });
  EXPECT_GT(leaves, 4u);
  EXPECT_EQ(seen, std::set<Segment>(given.begin(), given.end()));
}

}  // namespace
}  // namespace itin
