#include "triangulate/apex/selection.hpp"

#include <cmath>
#include <map>
#include <random>

#include <gtest/gtest.h>

#include <itin/store.hpp>

#include "libitin/store/random_points.hpp"
#include "support/seed.hpp"

namespace itin {
namespace {

/// Fine levels are read from the ground's own tree and coarse ones from theirs. Wherever rings lie, each vertex must
/// come from one of them, once.
TEST(Selection, TakesEachVertexOnceWhateverTheRings) {
  const test::TemporaryDirectory directory;
  test::GivenStore given = test::random_store(test::seed(), 9000);
  std::mt19937_64 random(test::seed());
  for (const int fine_levels : {1, 2, 3, 4}) {
    given.fine_levels = fine_levels;
    const std::string path = directory.file(std::to_string(fine_levels) + ".itin");
    given.write(path);
    const Store store(path);
    std::map<std::uint64_t, std::uint8_t> levels;
    for (const test::GivenLeaf& leaf : given.leaves)
      for (std::size_t k = 0; k < leaf.levels.size(); ++k) levels[code_of(leaf.points[k])] = leaf.levels[k];
    for (int i = 0; i < 60; ++i) {
      const auto uniform = [&](int low, int high) { return std::uniform_int_distribution<int>(low, high)(random); };
      std::vector<Ring> rings;
      double radius = 0;
      for (int level = uniform(0, 3); level <= 3; level += uniform(1, 2))
        rings.push_back({radius += uniform(1, 500), given.tolerances[static_cast<std::size_t>(level)]});
      rings.back().radius = std::numeric_limits<double>::infinity();
      const Point2 centre{given.grid.origin.x + uniform(-1400, 100), given.grid.origin.y + uniform(-100, 1400)};
      const Selection selection = selection_of(store.metadata(), Detail::rings(centre, rings), ThemeChoice::none());
      const int x = uniform(-140000, 10000), y = uniform(-10000, 140000), reach = 1 << uniform(6, 18);
      const GridBox box{x, y, x + reach, y + reach};
      std::map<std::uint64_t, std::uint8_t> expected;
      for (const auto& [code, level] : levels) {
        const std::int32_t px = morton_x(code), py = morton_y(code);
        if (box.contains(px, py) && selection.selects(level, px, py)) expected[code] = level;
      }
      std::vector<Leaf> leaves;
      selected_leaves(store.points(), selection, box, leaves);
      std::map<std::uint64_t, std::uint8_t> found;
      for (const Leaf& leaf : leaves) {
        const auto block = store.points().block(leaf);
        for (std::size_t k = 0; k < block->points.size(); ++k) {
          const GridPoint& p = block->points[k];
          const std::uint8_t level = level_of(leaf, *block, k);
          if (!box.contains(p.x, p.y) || !selection.selects(leaf, level, p.x, p.y)) continue;
          ASSERT_TRUE(found.emplace(code_of(p), level).second) << "a vertex came twice";
        }
      }
      ASSERT_EQ(found, expected) << fine_levels << " fine levels";
    }
  }
}

}  // namespace
}  // namespace itin
