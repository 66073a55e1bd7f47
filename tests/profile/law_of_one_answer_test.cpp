// Law 4 on real terrain: a profile from the store and SightLines on a window's triangles, to the last bit.
#include <cmath>
#include <filesystem>
#include <iostream>
#include <optional>
#include <random>

#include <gtest/gtest.h>

#include <itin/cross_section.hpp>
#include <itin/import.hpp>
#include <itin/store.hpp>
#include <itin/triangulate.hpp>
#include <profile/profile.hpp>

#include "lines/line_clearance.hpp"
#include "lines/obstructions.hpp"
#include "support/same_bits.hpp"
#include "support/seed.hpp"
#include "support/sight_lines.hpp"
#include "support/slow_section.hpp"
#include "support/temporary_directory.hpp"

namespace itin::profile {
namespace {

/// Two tiles of the Welsh coast that touch at a corner, and nothing beside them.
class CoastalStore : public ::testing::Test {
 protected:
  void SetUp() override {
    ImportOptions options;
    for (const char* tile : {"ss49", "ss58"}) {
      options.sources.push_back(ITIN_DATA_DIR "/os-terrain50-wales/tiles/" + std::string(tile) + ".zip");
      if (!std::filesystem::exists(options.sources.back())) GTEST_SKIP() << "no " << options.sources.back();
    }
    const std::string path = directory_.file("coast.itin");
    NoProgress progress;
    import_terrain(path, options, progress);
    store_.emplace(path);
    random_.seed(test::seed());
  }

  Point2 anywhere() {
    const Box box = store_->metadata().grid.box(store_->metadata().bounds);
    std::uniform_real_distribution<double> x(box.xmin - 300, box.xmax + 300), y(box.ymin - 300, box.ymax + 300);
    const Point2 p{x(random_), y(random_)};
    // Posts lie on multiples of 50 m plus 25: on one, and on lines through them, everything is a tie.
    const auto post = [](double v) { return std::round(v / 50) * 50; };
    return random_() % 3 == 0 ? Point2{post(p.x), post(p.y)} : p;
  }

  /// Up to three steps of the grid from `p`.
  Point2 beside(Point2 p) {
    const double reach = 3 * store_->metadata().grid.resolution;
    std::uniform_real_distribution<double> off(-reach, reach);
    return {p.x + off(random_), p.y + off(random_)};
  }

  test::TemporaryDirectory directory_;
  std::optional<Store> store_;
  std::mt19937 random_;
};

TEST_F(CoastalStore, GivesOneAnswer) {
  NoProgress progress;
  for (const double tolerance : {0.0, 4.0}) {
    const Detail detail = Detail::tolerance(tolerance);
    const Tin tin = triangulate(*store_, Window::all(), detail, progress);
    std::vector<std::array<GridPoint, 3>> triangles;
    for (const auto& [a, b, c] : tin.triangles) {
      triangles.push_back({tin.vertices[a], tin.vertices[b], tin.vertices[c]});
    }
    const Earth earth;
    const test::SightLines sight_lines(tin, earth);
    const SectionSurface surface(*store_, detail);
    std::uniform_real_distribution<double> height(0, 300);
    for (int i = 0; i < 300; ++i) {
      const Point2 a = anywhere(), b = i % 4 == 0 ? beside(a) : anywhere();
      const CrossSection section = cross_section(*store_, a, b, detail);
      if (i < 30) {
        const SectionLine line(tin.grid, a, b);
        const CrossSection slow = test::slow_section(line, triangles);
        ASSERT_EQ(section.breakpoints.size(), slow.breakpoints.size());
        ASSERT_EQ(section.gaps.size(), slow.gaps.size());
      }
      const CrossSection tiled = surface.between(a, b);
      ASSERT_EQ(section.gaps, tiled.gaps);
      ASSERT_EQ(section.breakpoints.size(), tiled.breakpoints.size());
      for (std::size_t k = 0; k < tiled.breakpoints.size(); ++k) {
        ASSERT_EQ(section.breakpoints[k].distance, tiled.breakpoints[k].distance);
        ASSERT_EQ(section.breakpoints[k].position, tiled.breakpoints[k].position);
      }
      const Antennas antennas{height(random_), height(random_)};
      const test::SightLine truth = sight_lines.between({a.x, a.y, antennas.from_m}, {b.x, b.y, antennas.to_m});
      const Profile profile = from_section(section);
      const auto found = line_clearance(profile, antennas, earth);
      ASSERT_EQ(truth.clearance.has_value(), found.has_value());
      if (!found) continue;
      ASSERT_TRUE(test::same_bits(*truth.clearance, found->clearance_m))
          << *truth.clearance << " " << found->clearance_m << " from " << a.x << " " << a.y << " to " << b.x << " "
          << b.y;
      const auto back =
          line_clearance(from_section(cross_section(*store_, b, a, detail)), {antennas.to_m, antennas.from_m}, earth);
      ASSERT_TRUE(test::same_bits(back->clearance_m, found->clearance_m));
      const bool cut = !obstructions(profile, antennas, earth, *found).empty();
      ASSERT_EQ(cut, !section.one_place && !truth.visible());
    }
  }
}

}  // namespace
}  // namespace itin::profile
