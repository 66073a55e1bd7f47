#include <algorithm>
#include <random>
#include <thread>

#include <gtest/gtest.h>

#include <itin/error.hpp>
#include <itin/store.hpp>

#include "libitin/store/random_points.hpp"
#include "store/codec/point_index.hpp"
#include "support/seed.hpp"

namespace itin {
namespace {

using test::GivenLeaf;
using test::GivenStore;

class StoreTest : public testing::Test {
 protected:
  void SetUp() override { given_.write(path_); }

  GridBox random_box(std::mt19937_64& random) const {
    const auto uniform = [&](int low, int high) { return std::uniform_int_distribution<int>(low, high)(random); };
    const int reach = 1 << uniform(0, 18);
    const int x = uniform(-140000, 10000), y = uniform(-10000, 140000);
    return {x, y, x + uniform(0, reach), y + uniform(0, reach)};
  }

  /// The ground serves fine levels, and each other level has a tree of its own.
  std::vector<const GivenLeaf*> expected_leaves(const LevelRange& asked, const GridBox& box) const {
    std::vector<const GivenLeaf*> out;
    for (const GivenLeaf& leaf : given_.leaves) {
      const bool wanted = leaf.level == 0 ? asked.finest < given_.fine_levels
                                          : leaf.level >= std::max(asked.finest, given_.fine_levels) &&
                                                asked.coarsest >= given_.fine_levels;
      if (wanted && !leaf.points.empty() && leaf.cell.box().meets(box)) out.push_back(&leaf);
    }
    return out;
  }

  /// Where one fine level is asked for, the ground's leaves are without finer vertices.
  static void expect_block(const Block& block, const GivenLeaf& leaf, int finest) {
    if (leaf.level > 0 || finest == 0) {
      ASSERT_EQ(block.points, leaf.points);
      ASSERT_EQ(test::each_of(block.sources), leaf.sources);
      ASSERT_EQ(block.levels, leaf.levels);
      return;
    }
    GivenLeaf rest;
    for (std::size_t k = 0; k < leaf.points.size(); ++k) {
      if (leaf.levels[k] < finest) continue;
      rest.points.push_back(leaf.points[k]);
      rest.sources.push_back(leaf.sources[k]);
      rest.levels.push_back(leaf.levels[k]);
    }
    ASSERT_EQ(block.points, rest.points);
    ASSERT_EQ(test::each_of(block.sources), rest.sources);
    ASSERT_EQ(block.levels, rest.levels);
  }

  void expect_leaves(const PointIndex& index, const LevelRange& asked, const GridBox& box) const {
    std::vector<Leaf> found;
    index.leaves(asked, box, found);
    const auto expected = expected_leaves(asked, box);
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
      const GivenLeaf& leaf = *expected[i];
      ASSERT_EQ(found[i].cell, leaf.cell);
      ASSERT_EQ(found[i].level, leaf.level == 0 ? 3 : leaf.level);
      ASSERT_LE(found[i].serves.finest, leaf.level == 0 ? asked.finest : given_.fine_levels);
      ASSERT_GE(found[i].serves.coarsest, leaf.level == 0 ? given_.fine_levels - 1 : 3);
      ASSERT_LE(found[i].asked, found[i].points);
      ASSERT_EQ(found[i].points, leaf.points.size());
      ASSERT_EQ(found[i].lo, leaf.lo);
      ASSERT_EQ(found[i].hi, leaf.hi);
      expect_block(*index.block(found[i]), leaf, found[i].serves.finest);
      for (const GridPoint& p : leaf.points) ASSERT_TRUE(p.z >= found[i].zmin && p.z <= found[i].zmax);
    }
  }

  const std::uint64_t seed_ = test::seed();
  const test::TemporaryDirectory directory_;
  const std::string path_ = directory_.file("random #1?%.itin");
  const GivenStore given_ = test::random_store(seed_, 12000);
};

TEST_F(StoreTest, MetadataIsWhatWasWritten) {
  const Store store(path_);
  const StoreMetadata& m = store.metadata();
  EXPECT_EQ(m.format_version, 11);
  EXPECT_EQ(m.fine_levels, given_.fine_levels);
  EXPECT_EQ(m.crs_wkt, "LOCAL_CS[\"test\"]");
  EXPECT_EQ(m.grid, given_.grid);
  EXPECT_FALSE(m.scale);
  EXPECT_EQ(m.sources.size(), 3u);
  EXPECT_EQ(m.sources[1].path, "b.tif");
  EXPECT_EQ(m.sources[1].gap_basis, (std::array<double, 4>{75, 0, 0, 75.5}));
  ASSERT_EQ(m.levels.size(), given_.tolerances.size());
  GridBox bounds;
  std::uint64_t vertices = 0;
  for (std::size_t level = 0; level < m.levels.size(); ++level) {
    std::uint64_t count = 0;
    std::int32_t lo = 0, hi = 0;
    for (const GivenLeaf& leaf : given_.leaves) {
      count += static_cast<std::uint64_t>(std::count(leaf.levels.begin(), leaf.levels.end(), level));
      if (leaf.level != static_cast<int>(level)) continue;
      lo = std::min(lo, leaf.lo), hi = std::max(hi, leaf.hi);
      for (const GridPoint& p : leaf.points) bounds.extend(p.x, p.y);
    }
    EXPECT_EQ(m.levels[level].tolerance, given_.tolerances[level]);
    EXPECT_EQ(m.levels[level].vertices, count);
    EXPECT_EQ(m.levels[level].certified_error.lo, lo * 0.01);
    EXPECT_EQ(m.levels[level].certified_error.hi, hi * 0.01);
    vertices += count;
  }
  EXPECT_EQ(m.vertices, vertices);
  EXPECT_EQ(m.bounds, bounds);
  EXPECT_EQ(store.file_bytes(), test::read_bytes(path_).size());
}

TEST_F(StoreTest, LeavesAndBlocksAreThoseOfAScan) {
  const Store store(path_);
  std::mt19937_64 random(seed_);
  for (int i = 0; i < 300; ++i) {
    const int finest = static_cast<int>(random() % 4), coarsest = std::min(3, finest + static_cast<int>(random() % 3));
    expect_leaves(store.points(), {finest, coarsest}, random_box(random));
  }
  constexpr std::int32_t far = 2000000000;
  expect_leaves(store.points(), {}, {-far, -far, far, far});
  expect_leaves(store.points(), {}, {});
}

TEST_F(StoreTest, SegmentsAreThoseOfAScan) {
  const Store store(path_);
  std::mt19937_64 random(seed_);
  for (int i = 0; i < 300; ++i) {
    const GridBox box = random_box(random);
    std::vector<Segment> found;
    store.points().segments(box, found);
    std::sort(found.begin(), found.end());
    for (const Segment& s : given_.segments) {
      // Liang and Barsky.
      const double dx = s.bx - s.ax, dy = s.by - s.ay;
      double low = 0, high = 1;
      const auto clip = [&](double p, double q) {
        if (p == 0) return q >= 0;
        (p < 0 ? low = std::max(low, q / p) : high = std::min(high, q / p));
        return true;
      };
      const bool meets = clip(-dx, double(s.ax) - box.xmin) && clip(dx, double(box.xmax) - s.ax) &&
                         clip(-dy, double(s.ay) - box.ymin) && clip(dy, double(box.ymax) - s.ay) && low <= high;
      if (meets) {
        ASSERT_TRUE(std::binary_search(found.begin(), found.end(), s));
      }
    }
    for (const Segment& s : found) {
      ASSERT_NE(std::find(given_.segments.begin(), given_.segments.end(), s), given_.segments.end());
    }
  }
}

TEST_F(StoreTest, CertifiedErrorIsTheWidestOfTheCellsMet) {
  const Store store(path_);
  std::mt19937_64 random(seed_);
  for (int i = 0; i < 300; ++i) {
    const GridBox grid_box = random_box(random);
    for (int level = 0; level < 4; ++level) {
      std::optional<std::pair<std::int32_t, std::int32_t>> expected;
      for (const GivenLeaf& leaf : given_.leaves) {
        if (leaf.level != level || !leaf.cell.box().meets(grid_box)) continue;
        if (!expected) expected = {leaf.lo, leaf.hi};
        expected->first = std::min(expected->first, leaf.lo);
        expected->second = std::max(expected->second, leaf.hi);
      }
      // A hair inside, for metres are not exact.
      Box box = given_.grid.box(grid_box);
      box.xmin += 1e-7, box.ymin += 1e-7, box.xmax -= 1e-7, box.ymax -= 1e-7;
      if (box.empty()) continue;
      const auto found = store.certified_error(level, box);
      ASSERT_EQ(found.has_value(), expected.has_value());
      if (!found) continue;
      ASSERT_EQ(found->lo, expected->first * 0.01);
      ASSERT_EQ(found->hi, expected->second * 0.01);
    }
  }
  EXPECT_THROW(store.certified_error(4, {}), InputError);
  EXPECT_THROW(store.certified_error(-1, {}), InputError);
}

TEST_F(StoreTest, PointsAboutAreTheSharesOfTheCellsMet) {
  const Store store(path_);
  std::mt19937_64 random(seed_);
  for (int i = 0; i < 300; ++i) {
    // Every tenth box holds whole chunks of the directory.
    const GridBox grid_box = i % 10 == 0 ? GridBox{-1000000, -1000000, 1000000, 1000000} : random_box(random);
    for (int level = 0; level < 4; ++level) {
      double expected = 0;
      for (const GivenLeaf& leaf : given_.leaves) {
        const GridBox there = intersection(leaf.cell.box(), store.metadata().bounds),
                      shared = intersection(there, grid_box);
        const bool counts = level == 0 ? leaf.level == 0 : leaf.level >= level;
        if (!counts || leaf.points.empty() || shared.empty()) continue;
        const auto positions = [](const GridBox& b) {
          return (double{1} * b.xmax - b.xmin + 1) * (double{1} * b.ymax - b.ymin + 1);
        };
        expected += static_cast<double>(leaf.points.size()) * positions(shared) / positions(there);
      }
      // Metres are not exact: the box may be a unit wider.
      const std::uint64_t about = store.points_about(level, given_.grid.box(grid_box));
      const double slack = 1 + 0.001 * expected + 2 * std::sqrt(expected);
      ASSERT_NEAR(static_cast<double>(about), expected, i % 10 == 0 ? 1 : slack);
    }
  }
  EXPECT_THROW(store.points_about(4, {}), InputError);
}

TEST_F(StoreTest, ThreadsShareATinyCache) {
  for (const std::uint64_t cache_bytes : {0u, 200000u, 100000000u}) {
    const Store store(path_, {cache_bytes});
    std::vector<std::thread> threads;
    for (std::uint64_t t = 0; t < 4; ++t) {
      threads.emplace_back([&, t] {
        std::mt19937_64 random(seed_ + t % 2);  // two threads each ask the same
        for (int i = 0; i < 60; ++i) expect_leaves(store.points(), {}, random_box(random));
      });
    }
    for (auto& t : threads) t.join();
  }
}

TEST_F(StoreTest, SoundStoreHasNoDamage) {
  NoProgress progress;
  for (const Damage& d : check(Store(path_), progress)) ADD_FAILURE() << d.place << ": " << d.what;
}

TEST_F(StoreTest, SameContentSameBytes) {
  const std::string again = directory_.file("again.itin");
  given_.write(again);
  EXPECT_EQ(test::read_bytes(path_), test::read_bytes(again));
}

TEST_F(StoreTest, MovedStoreGoesOn) {
  Store first(path_);
  Store second(std::move(first));
  expect_leaves(second.points(), {}, {-2000, 0, 20000, 20000});
}

}  // namespace
}  // namespace itin
