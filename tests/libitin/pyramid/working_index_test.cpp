// What a leaf's coarse points are follows all changes of levels.
#include "pyramid/working_index.hpp"

#include <algorithm>
#include <map>
#include <random>

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

}  // namespace
}  // namespace itin
