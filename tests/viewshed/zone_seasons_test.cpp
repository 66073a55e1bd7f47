// Turbines seen through woods in summer and in winter: what lines of sight to their tips and hubs say.
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include <itin/import.hpp>
#include <itin/store.hpp>
#include <profile/foliage.hpp>
#include <viewshed/tasks.hpp>
#include <viewshed/turbines.hpp>

#include "support/rolling_hill.hpp"

namespace itin::viewshed {
namespace {

class ZoneSeasons : public test::RollingHill {
 protected:
  void SetUp() override {
    RollingHill::SetUp();
    add("woods", ThemeKind::Vegetation, 12, 60, 12);
    request_.turbines = {
        {.number = 1, .position = {300105.5, 199510.5}, .tip_height = 25, .hub_height = 18, .radius = 500},
        {.number = 3, .position = {300455.5, 199805.5}, .tip_height = 20, .radius = 400}};
    request_.cell_size = 20;
    request_.themes = ThemeChoice::all();
    request_.foliage = {.extinction = 0.5, .least_transmittance = 0.3};
  }
  void add(const std::string& theme, ThemeKind kind, int count, double side, double height) {
    std::vector<test::LineFeature> features;
    for (int i = 0; i < count; ++i) {
      const double x = in(300010, 300590 - side), y = in(199420, 199990 - side);
      features.push_back(test::box(x, y, x + in(side / 6, side), y + in(side / 6, side), in(height / 3, height)));
    }
    test::import_raised(path(), directory_.file(theme + ".geojson"), kind, theme, features);
  }

  bool sees(const Store& store, Point2 eye, const Turbine& turbine, double height, double leaf_area) const {
    profile::LosQuery query;
    query.from_height_m = request_.observer_height, query.to_height_m = height;
    query.earth = request_.earth;
    return profile::through_foliage(store, {.from = eye, .to = turbine.position, .themes = *request_.themes}, query,
                                    {.leaf_area = leaf_area, .least_transmittance = 0.3})
               .verdict == profile::SightVerdict::kVisible;
  }

  /// Counts what single lines of sight see from some cells again.
  void expect_agreement(const Store& store, const Zone& zone, int wanted) {
    const Visibility& full = zone.screened ? *zone.screened : zone.bare;
    int between = 0;
    for (std::size_t cell = 0; cell < zone.bare.tip_count.size(); ++cell) {
      const auto tips = [&](const SeasonCounts& counts) { return counts.tip_count[cell]; };
      if (zone.bare.tip_count[cell] == kCountOutside) {
        EXPECT_EQ(tips(zone.seasons->summer), kCountOutside);
        continue;
      }
      EXPECT_LE(full.tip_count[cell], tips(zone.seasons->summer));
      EXPECT_LE(tips(zone.seasons->summer), tips(zone.seasons->winter));
      EXPECT_LE(tips(zone.seasons->winter), zone.bare.tip_count[cell]);
      EXPECT_LE(full.hub_count[cell], zone.seasons->summer.hub_count[cell]);
      EXPECT_LE(zone.seasons->winter.hub_count[cell], zone.bare.hub_count[cell]);
      const bool open = full.tip_count[cell] < zone.bare.tip_count[cell];
      if (!open || between >= wanted) continue;
      ++between;
      const auto columns = static_cast<std::size_t>(zone.grid.columns());
      const Point2 eye =
          zone.grid.centre(static_cast<std::int64_t>(cell % columns), static_cast<std::int64_t>(cell / columns));
      for (const auto& [counts, leaf_area] : {std::pair(&zone.seasons->summer, profile::kLeavesOn),
                                              std::pair(&zone.seasons->winter, profile::kLeavesOff)}) {
        int of_tips = 0, of_hubs = 0;
        for (const Turbine& t : zone.request.turbines) {
          if (std::hypot(t.position.x - eye.x, t.position.y - eye.y) > t.radius) continue;
          of_tips += sees(store, eye, t, t.tip_height, leaf_area) ? 1 : 0;
          if (t.hub_height) of_hubs += sees(store, eye, t, *t.hub_height, leaf_area) ? 1 : 0;
        }
        EXPECT_EQ(counts->tip_count[cell], of_tips) << cell << ' ' << leaf_area;
        EXPECT_EQ(counts->hub_count[cell], of_hubs) << cell << ' ' << leaf_area;
      }
    }
    EXPECT_GT(between, 10);
  }

  ZoneRequest request_;
};

TEST_F(ZoneSeasons, AreWhatLinesOfSightSay) {
  const Store store(path());
  const Zone zone = survey_turbines(store, request_, progress_);
  ASSERT_TRUE(zone.seasons);
  expect_agreement(store, zone, 60);
  EXPECT_NE(zone.seasons->summer.tip_count, zone.seasons->winter.tip_count);
}

TEST_F(ZoneSeasons, AreHiddenByHousesInAnySeason) {
  add("houses", ThemeKind::Buildings, 15, 20, 9);
  const Store store(path());
  const Zone zone = survey_turbines(store, request_, progress_);
  expect_agreement(store, zone, 60);
  request_.cell_size = 5;
  const Zone whole = survey_turbines(store, request_, progress_);
  ZoneTasks tasks(store, request_, 4096, progress_);
  EXPECT_GT(tasks.list().size(), 2U);
  for (std::size_t i = tasks.list().size(); i-- > 0;) tasks.add(i, tasks.answer(i, progress_));
  const Zone merged = tasks.take();
  for (const auto season : {&Seasons::summer, &Seasons::winter}) {
    EXPECT_EQ(((*merged.seasons).*season).tip_count, ((*whole.seasons).*season).tip_count);
    EXPECT_EQ(((*merged.seasons).*season).hub_count, ((*whole.seasons).*season).hub_count);
  }
  EXPECT_EQ(merged.screened->hubs, whole.screened->hubs);
}

}  // namespace
}  // namespace itin::viewshed
