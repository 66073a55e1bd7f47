// What a leaf's coarse points are follows all changes of levels. The cells that levels are chosen and mended in are the
// largest that are not too full.
#include "pyramid/points/working_index.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <random>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "support/seed.hpp"

namespace itin {
namespace {

constexpr int kIndexLevels = 4;
constexpr std::uint32_t kPointsOfLeaf = 16;
constexpr GridBox kAllOfIt{-1000, -1000, 1000, 1000};

using LevelByCode = std::map<std::uint64_t, int>;

LevelByCode selected(const LevelByCode& all, int finest) {
  LevelByCode result = all;
  std::erase_if(result, [&](const auto& point) { return point.second < finest; });
  return result;
}

LevelByCode read(const WorkingIndex& index, int finest) {
  LevelByCode result;
  std::vector<Leaf> leaves;
  index.leaves({finest, finest}, kAllOfIt, leaves);
  for (const Leaf& leaf : leaves) {
    const auto block = index.block(leaf);
    std::uint32_t points = 0;
    for (std::size_t i = 0; i < block->points.size(); ++i) {
      if (level_of(leaf, *block, i) < finest) continue;
      result[code_of(block->points[i])] = level_of(leaf, *block, i);
      points += 1;
    }
    EXPECT_EQ(points, leaf.points);
  }
  return result;
}

TEST(WorkingIndices, ReadThePointsOfEachLevelAsTheyAreNow) {
  std::mt19937 random(test::seed());
  const auto draw = [&](int low, int high) { return std::uniform_int_distribution<int>(low, high)(random); };
  PointSorter sorter("/tmp", 1 << 24);
  LevelByCode expected;
  for (int i = 0; i < 500; ++i) {
    const std::uint64_t code = morton(draw(-900, 900), draw(-900, 900));
    if (expected.try_emplace(code, 0).second) sorter.add({code, draw(0, 9), 0, 0});
  }
  NoProgress progress;
  SortedPoints points = sorter.finish(std::array{SourceRank{1.0}}, progress);
  WorkingIndex index(points, kIndexLevels, kPointsOfLeaf);
  const auto any_code = [&] {
    return std::next(expected.begin(), draw(0, static_cast<int>(expected.size()) - 1))->first;
  };
  for (int round = 0; round < 30; ++round) {
    if (round == 10) index.keep_coarse_points();
    std::vector<LevelRaise> raises;
    for (int i = draw(0, 20); i > 0; --i) raises.push_back({any_code(), draw(1, kIndexLevels - 1)});
    for (const LevelRaise& raise : raises) expected[raise.code] = std::max(expected[raise.code], raise.level);
    index.promote(raises);
    const std::vector<std::uint64_t> dropped{any_code(), any_code()};
    for (const std::uint64_t code : dropped) expected.erase(code);
    index.drop(dropped);
    for (int k = 0; k < kIndexLevels; ++k) ASSERT_EQ(read(index, k), selected(expected, k)) << "level " << k;
  }
}

/// Points, and which of them have level 2, by their codes.
struct CodesOfLevel {
  std::vector<std::uint64_t> all, of_level;

  static std::size_t in(const std::vector<std::uint64_t>& codes, const Cell& cell) {
    return static_cast<std::size_t>(std::lower_bound(codes.begin(), codes.end(), cell.end()) -
                                    std::lower_bound(codes.begin(), codes.end(), cell.code));
  }
};

/// Divides a cell until its parts are not too full or leaves, and appends those that meet the points' bounds.
template <class Fits>
void divide(const WorkingIndex& index, const CodesOfLevel& codes, const Cell& cell, const Fits& fits,
            std::vector<Cell>& out) {
  if (!square_of(cell).meets(index.bounds())) return;
  const bool is_leaf = index.ranges()[index.leaf_of(cell.code)].cell == cell;
  if (is_leaf || fits(CodesOfLevel::in(codes.all, cell), CodesOfLevel::in(codes.of_level, cell))) {
    out.push_back(cell);
    return;
  }
  for (int i = 0; i < 4; ++i) divide(index, codes, cell.child(i), fits, out);
}

TEST(WorkingIndices, HaveTheLargestCellsThatAreNotTooFull) {
  std::mt19937 random(test::seed());
  const auto draw = [&](int low, int high) { return std::uniform_int_distribution<int>(low, high)(random); };
  std::set<std::uint64_t> all;
  // Three crowds, of different density, and strays.
  for (const auto& [x, y, side, count] : {std::array{0, 0, 300, 40000}, std::array{5000, 300, 2000, 40000},
                                          std::array{-70000, -900, 500, 9000}, std::array{0, 0, 99999, 500}})
    for (int i = 0; i < count; ++i) all.insert(morton(x + draw(-side, side), y + draw(-side, side)));
  PointSorter sorter("/tmp", 1 << 24);
  for (const std::uint64_t code : all) sorter.add({code, 0, 0, 0});
  NoProgress progress;
  SortedPoints points = sorter.finish(std::array{SourceRank{1.0}}, progress);
  WorkingIndex index(points, kIndexLevels, kPointsOfLeaf);
  CodesOfLevel codes{{all.begin(), all.end()}, {}};
  std::vector<LevelRaise> raises;
  for (const std::uint64_t code : all) {
    if (draw(0, morton_y(code) > 0 ? 3 : 99) != 0) continue;
    codes.of_level.push_back(code);
    raises.push_back({code, 2});
  }
  index.promote(raises);
  const auto expect_cells = [&](const std::vector<CurveRange>& found, const auto& fits) {
    std::vector<Cell> expected;
    divide(index, codes, {}, fits, expected);
    ASSERT_EQ(found.size(), expected.size());
    EXPECT_GT(found.size(), 3U);
    for (std::size_t i = 0; i < found.size(); ++i) {
      EXPECT_EQ(found[i].cell, expected[i]);
      EXPECT_EQ(found[i].count, CodesOfLevel::in(codes.all, expected[i]));
    }
  };
  expect_cells(index.work_cells(), [](std::size_t count, std::size_t) { return count <= 65536; });
  expect_cells(index.mending_cells(2), [](std::size_t count, std::size_t of_level) {
    return count <= 2048 || (count <= 32768 && of_level <= 512);
  });
}

}  // namespace
}  // namespace itin
