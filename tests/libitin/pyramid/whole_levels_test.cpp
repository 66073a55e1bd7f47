// Levels that were triangulated as a whole, against triangulate_region() box by box.
#include "pyramid/levels/whole_levels.hpp"

#include <random>

#include <gtest/gtest.h>

#include "pyramid/levels/cell_verification.hpp"
#include "support/seed.hpp"
#include "support/temporary_directory.hpp"

namespace itin {
namespace {

/// Points about two coasts at all levels, and few at coarse levels between them.
SortedPoints two_coasts(const std::string& directory, std::mt19937& random) {
  PointSorter sorter(directory, std::uint64_t{1} << 20);
  const auto in = [&](std::int32_t low, std::int32_t high) {
    return low + static_cast<std::int32_t>(random() % static_cast<unsigned>(high - low));
  };
  for (int i = 0; i < 6000; ++i) {
    const std::int32_t coast = i % 2 == 0 ? 0 : 900000;
    sorter.add({morton(in(coast, coast + 100000), in(0, 1000000)), in(0, 9000), 0, 0});
  }
  for (int i = 0; i < 6000; ++i) sorter.add({morton(in(100000, 900000), in(0, 1000000)), 0, 0, 0});
  NoProgress progress;
  const std::vector<SourceRank> ranks(1);
  return sorter.finish(ranks, progress);
}

TEST(WholeLevels, AreTheTrianglesOfEachBox) {
  const test::TemporaryDirectory directory;
  std::mt19937 random(test::seed());
  SortedPoints points = two_coasts(directory.path(), random);
  const std::vector<std::int32_t> tolerances{0, 50, 100, 200};
  WorkingIndex index(points, 4, 64);
  std::vector<LevelRaise> raises;
  for (const CurveRange& leaf : index.ranges()) {
    for (const RawPoint& p : index.read(leaf)) {
      const bool land = p.z != 0;
      if (random() % (land ? 3 : 300) == 0) raises.push_back({p.code, 1 + static_cast<int>(random() % 3)});
    }
  }
  index.promote(std::move(raises));
  const WholeLevels whole(index, tolerances, 0b1110);
  for (int run = 0; run < 200; ++run) {
    const int level = 1 + static_cast<int>(random() % 3);
    const auto x = static_cast<std::int32_t>(random() % 1000000), y = static_cast<std::int32_t>(random() % 1000000),
               side = static_cast<std::int32_t>(random() % 200000);
    const GridBox box{x, y, x + side, y + side};
    const auto held = whole.in(level, box);
    ASSERT_TRUE(held);
    const RegionMesh made = triangulate_region(index, levels_from(level, tolerances), box);
    ASSERT_EQ(held->vertices.size(), made.vertices.size()) << "run " << run << ", seed " << test::seed();
    for (std::size_t v = 0; v < made.vertices.size(); ++v) EXPECT_EQ(held->vertices[v].point, made.vertices[v].point);
    EXPECT_TRUE(held->mesh.triangles == made.mesh.triangles) << "run " << run << ", seed " << test::seed();
    EXPECT_TRUE(held->mesh.neighbours == made.mesh.neighbours) << "run " << run << ", seed " << test::seed();
  }
  EXPECT_FALSE(WholeLevels(index, tolerances, 0b0110).in(3, index.bounds())) << "not asked for";
}

}  // namespace
}  // namespace itin
