// Long sight lines between Welsh hills (OS Terrain 50) that walkers know, and what refraction does to them.
#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>
#include <set>

#include <gtest/gtest.h>

#include <itin/cross_section.hpp>
#include <itin/import.hpp>
#include <itin/store.hpp>
#include <profile/los.hpp>

#include "support/temporary_directory.hpp"

namespace itin::profile {

namespace {

constexpr Point2 kSnowdon{260975, 354375}, kCadairIdris{271125, 313025}, kPenYFan{301225, 221575};

/// The 10 km tile of the National Grid, as the data's files are called; for Wales only.
std::string tile_at(Point2 p) {
  const std::string square = p.x < 300000 ? (p.y < 300000 ? "sn" : "sh") : (p.y < 300000 ? "so" : "sj");
  const auto digit = [](double v) { return std::to_string(static_cast<int>(v / 10000) % 10); };
  return square + digit(p.x) + digit(p.y);
}

class WelshHills : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    std::set<std::string> tiles;
    for (const Point2 to : {kCadairIdris, kPenYFan}) {
      for (int i = 0; i <= 1000; ++i) {
        const double t = i / 1000.0;
        for (const double aside : {-200.0, 200.0}) {
          tiles.insert(tile_at({kSnowdon.x + (to.x - kSnowdon.x) * t + aside, kSnowdon.y + (to.y - kSnowdon.y) * t}));
        }
      }
    }
    ImportOptions options;
    options.tolerances = {16};
    for (const std::string& tile : tiles) {
      options.sources.push_back(ITIN_DATA_DIR "/os-terrain50-wales/tiles/" + tile + ".zip");
      if (!std::filesystem::exists(options.sources.back())) return;
    }
    directory_ = std::make_unique<test::TemporaryDirectory>();
    NoProgress progress;
    import_terrain(directory_->file("hills.itin"), options, progress);
    store_ = std::make_unique<Store>(directory_->file("hills.itin"));
  }
  static void TearDownTestSuite() {
    store_.reset();
    directory_.reset();
  }
  void SetUp() override {
    if (!store_) GTEST_SKIP() << "no " ITIN_DATA_DIR "/os-terrain50-wales/tiles";
  }

  static LosReport look(Point2 from, Point2 to, const Earth& earth) {
    LosQuery query;
    query.from_height_m = query.to_height_m = 2;
    query.earth = earth;
    return analyse(from_section(cross_section(*store_, from, to, Detail::tolerance(0))), query);
  }
  static Earth refracting(double k) {
    Earth earth;
    earth.refraction = k;
    return earth;
  }

  static inline std::unique_ptr<test::TemporaryDirectory> directory_;
  static inline std::unique_ptr<Store> store_;
};

TEST_F(WelshHills, SnowdonSeesCadairIdrisInAnyAir) {
  for (const double k : {0.0, 0.13, 0.25}) {
    const LosReport report = look(kSnowdon, kCadairIdris, refracting(k));
    EXPECT_EQ(report.verdict, SightVerdict::kVisible) << k;
    EXPECT_NEAR(report.profile.length_m, 42578, 1);
    EXPECT_EQ(look(kCadairIdris, kSnowdon, refracting(k)).verdict, SightVerdict::kVisible) << k;
  }
}

TEST_F(WelshHills, SnowdonSeesPenYFanByRadioOnly) {
  // 138.8 km: by light Plynlimon stands in the way, 69.8 km from both; with radio's refraction it does not.
  const LosReport straight = look(kSnowdon, kPenYFan, refracting(0)),
                  light = look(kSnowdon, kPenYFan, refracting(0.13));
  const LosReport radio = look(kSnowdon, kPenYFan, Earth::effective_earth(4.0 / 3));
  EXPECT_EQ(straight.verdict, SightVerdict::kHidden);
  EXPECT_EQ(light.verdict, SightVerdict::kHidden);
  EXPECT_EQ(radio.verdict, SightVerdict::kVisible);
  EXPECT_LT(*straight.clearance_m, *light.clearance_m - 30);
  EXPECT_NEAR(light.critical->distance_m, 69800, 100);
  for (const double k : {0.0, 0.13, 0.25}) {
    EXPECT_EQ(look(kPenYFan, kSnowdon, refracting(k)).verdict, look(kSnowdon, kPenYFan, refracting(k)).verdict) << k;
  }
}

}  // namespace

}  // namespace itin::profile
