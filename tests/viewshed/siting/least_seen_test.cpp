// Turbines placed on real terrain, against the zone of visibility of those that were chosen.
#include <algorithm>
#include <cmath>

#include <gdal_priv.h>
#include <gtest/gtest.h>

#include <itin/import.hpp>
#include <itin/parallel.hpp>
#include <viewshed/site_coverage.hpp>
#include <viewshed/turbine_layout.hpp>
#include <viewshed/turbines.hpp>

#include "support/houses.hpp"
#include "support/raster_file.hpp"
#include "support/temporary_directory.hpp"
#include "support/vector_file.hpp"

namespace itin::viewshed {
namespace {

constexpr int kCropSide = 140;
constexpr double kCropStep = 50, kTip = 125, kHub = 80, kReach = 2500;
constexpr Point2 kCropCorner{305025, 205025};

/// A piece of OS Terrain 50 north of Cardiff with a row of houses, candidates in its middle.
class LeastSeen : public ::testing::Test {
 protected:
  void SetUp() override {
    GDALAllRegister();
    const std::string path = std::string(ITIN_SOURCE_DIR) + "/scripts/demo-data/cardiff.tif";
    const GDALDatasetUniquePtr dataset(GDALDataset::Open(path.c_str(), GDAL_OF_RASTER));
    ASSERT_TRUE(dataset);
    std::vector<double> z(std::size_t{kCropSide} * kCropSide);
    ASSERT_EQ(dataset->GetRasterBand(1)->RasterIO(GF_Read, 100, 100, kCropSide, kCropSide, z.data(), kCropSide,
                                                  kCropSide, GDT_Float64, 0, 0, nullptr),
              CE_None);
    test::write_raster(
        directory_.file("t.tif"), {kCropCorner.x, kCropCorner.y, kCropStep, kCropSide, kCropSide, 27700},
        [&](int c, int r) { return z[static_cast<std::size_t>(r) * kCropSide + static_cast<std::size_t>(c)]; });
    ImportOptions terrain;
    terrain.sources = {directory_.file("t.tif")};
    import_terrain(directory_.file("t.itin"), terrain, progress_);
    std::vector<test::LineFeature> houses;
    for (int i = 0; i < 12; ++i) {
      const double x = kCropCorner.x + 1500 + 300 * i, y = kCropCorner.y - 3000 - 40 * i;
      houses.push_back(test::box(x, y, x + 150, y + 30, 30));
    }
    test::import_houses(directory_.file("t.itin"), directory_.file("h.geojson"), houses);
    store_.emplace(directory_.file("t.itin"));

    const double west = kCropCorner.x + 2600, north = kCropCorner.y - 2600;
    places_ = spaced_positions(Window::box({west, north - 1800, west + 1800, north}), 360);
    const auto ground = ground_under(*store_, places_, ThemeChoice::none(), progress_);
    for (std::size_t i = 0; i < places_.size(); ++i) grounds_.push_back(ground[i].value());
  }

  SiteSurvey survey(double height, const ThemeChoice& themes) const {
    SiteSurvey survey;
    for (std::size_t i = 0; i < places_.size(); ++i)
      survey.positions.push_back({std::to_string(i), places_[i], height, grounds_[i]});
    survey.radius = kReach;
    survey.targets.height = 2;
    survey.targets.grid = grid_of_reach(*store_, survey.positions, kReach, 50);
    survey.themes = themes;
    return survey;
  }

  ChoiceGoal goal() const {
    ChoiceGoal goal{.objective = Objective::kLeast, .count = 4};
    goal.compatible = [this](std::size_t a, std::size_t b) { return spacing_.keeps_apart(places_[a], places_[b]); };
    return goal;
  }

  Choice choose_on(const SiteSurvey& survey) {
    std::vector<SiteOption> options;
    for (std::size_t i = 0; i < places_.size(); ++i) options.push_back({i, 1});
    SiteCoverage coverage(*store_, survey, progress_);
    coverage.explore();
    return choose(Demand(element_count(*survey.targets.grid)), options, coverage, goal(), progress_);
  }

  Zone zone_of(const Choice& choice, const RasterGrid& grid, const ThemeChoice& themes) {
    ZoneRequest request;
    for (const ChosenSite& site : choice.chosen)
      request.turbines.push_back({.number = request.turbines.size() + 1,
                                  .name = {},
                                  .farm = {},
                                  .position = places_[site.option],
                                  .tip_height = kTip,
                                  .hub_height = kHub,
                                  .rotor_diameter = 90,
                                  .radius = kReach});
    request.grid = grid;
    if (themes.includes_raised(store_->metadata().themes)) request.themes = themes;
    return survey_turbines(*store_, request, progress_);
  }

  static Weight cells_seeing(const std::vector<std::uint16_t>& counts) {
    return std::count_if(counts.begin(), counts.end(), [](std::uint16_t n) { return n > 0 && n != kCountOutside; });
  }

  test::TemporaryDirectory directory_;
  NoProgress progress_;
  std::optional<Store> store_;
  std::vector<Point2> places_;
  std::vector<double> grounds_;
  TurbineSpacing spacing_{450, 270, 240};
};

TEST_F(LeastSeen, IsWhatTheZoneOfTheChosenTurbinesCounts) {
  for (const ThemeChoice& themes : {ThemeChoice::none(), ThemeChoice::all()}) {
    for (const double height : {kTip, kHub}) {
      const SiteSurvey looked_for = survey(height, themes);
      const Choice choice = choose_on(looked_for);
      ASSERT_EQ(choice.chosen.size(), 4U);
      for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = 0; j < i; ++j)
          EXPECT_TRUE(spacing_.keeps_apart(places_[choice.chosen[i].option], places_[choice.chosen[j].option]));
      const Zone zone = zone_of(choice, *looked_for.targets.grid, themes);
      const Visibility& seen = zone.screened ? *zone.screened : zone.bare;
      EXPECT_EQ(zone.screened.has_value(), themes.includes_raised(store_->metadata().themes));
      EXPECT_EQ(cells_seeing(height == kTip ? seen.tip_count : seen.hub_count), choice.value);
      EXPECT_GT(choice.value, 0);
      EXPECT_LE(choice.lower_bound, choice.value);
    }
  }
}

TEST_F(LeastSeen, DoesNotDependOnTheNumberOfThreads) {
  const SiteSurvey tips = survey(kTip, ThemeChoice::none());
  set_thread_count(1);
  const Choice one = choose_on(tips);
  set_thread_count(0);
  const Choice many = choose_on(tips);
  EXPECT_EQ(one.value, many.value);
  EXPECT_EQ(one.lower_bound, many.lower_bound);
  ASSERT_EQ(one.chosen.size(), many.chosen.size());
  for (std::size_t i = 0; i < one.chosen.size(); ++i) EXPECT_EQ(one.chosen[i].option, many.chosen[i].option);
}

/// By trying every four of them that keep apart.
TEST_F(LeastSeen, IsTheLeastOfAllChoices) {
  const SiteSurvey tips = survey(kTip, ThemeChoice::none());
  SiteCoverage coverage(*store_, tips, progress_);
  coverage.explore();
  std::vector<DemandSet> sets;
  for (std::size_t i = 0; i < places_.size(); ++i) {
    while (!coverage.bounds(i).exact) coverage.refine({&i, 1});
    sets.push_back(coverage.bounds(i).certain);
  }
  std::size_t least = element_count(*tips.targets.grid);
  const auto apart = [&](std::size_t a, std::size_t b) { return spacing_.keeps_apart(places_[a], places_[b]); };
  for (std::size_t a = 0; a < sets.size(); ++a)
    for (std::size_t b = 0; b < a; ++b) {
      if (!apart(a, b)) continue;
      const DemandSet two = set_union(sets[a], sets[b]);
      for (std::size_t c = 0; c < b; ++c) {
        if (!apart(a, c) || !apart(b, c)) continue;
        const DemandSet three = set_union(two, sets[c]);
        if (three.size() >= least) continue;
        for (std::size_t d = 0; d < c; ++d)
          if (apart(a, d) && apart(b, d) && apart(c, d)) least = std::min(least, set_union(three, sets[d]).size());
      }
    }
  const Choice choice = choose_on(tips);
  EXPECT_EQ(choice.value, static_cast<Weight>(least));
  EXPECT_EQ(choice.lower_bound, choice.value);
}

}  // namespace
}  // namespace itin::viewshed
