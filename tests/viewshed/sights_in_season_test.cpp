// What dwellings see of turbines through woods, in summer and in winter: what single lines of sight say.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include <itin/error.hpp>
#include <itin/store.hpp>
#include <profile/foliage.hpp>
#include <viewshed/dwellings.hpp>

#include "support/rolling_hill.hpp"

namespace itin::viewshed {
namespace {

constexpr double kLeastLight = 0.3;

class SightsOfSeasons : public test::RollingHill {
 protected:
  void SetUp() override {
    RollingHill::SetUp();
    std::vector<test::LineFeature> woods;
    for (int i = 0; i < 14; ++i) {
      const double x = in(300010, 300520), y = in(199420, 199920);
      woods.push_back(test::box(x, y, x + in(8, 70), y + in(8, 70), in(4, 15)));
    }
    test::import_raised(path(), directory_.file("woods.geojson"), ThemeKind::Vegetation, "woods", woods);
    request_.turbines.turbines = {
        {.number = 1, .position = {300105.5, 199510.5}, .tip_height = 28, .hub_height = 19, .rotor_diameter = 18},
        {.number = 2, .position = {300455.5, 199805.5}, .tip_height = 22}};
    for (int i = 0; i < 40; ++i)
      request_.dwellings.places.push_back({.name = "d", .position = {in(300010, 300590), in(199420, 199990)}});
    request_.foliage = {.extinction = 0.5, .least_transmittance = kLeastLight};
    request_.flicker.year = {2027, 0};
  }

  /// Whether a single line through the woods sees so high above the turbine's ground.
  bool sees(const Store& store, const DwellingFacade& facade, const Turbine& turbine, double height,
            double leaf_area) const {
    profile::LosQuery query;
    query.from_height_m = request_.eye_height, query.to_height_m = height;
    query.earth = request_.earth;
    return profile::through_foliage(store, {.from = facade.position, .to = turbine.position, .themes = request_.themes},
                                    query, {.leaf_area = leaf_area, .least_transmittance = kLeastLight})
               .verdict == profile::SightVerdict::kVisible;
  }

  /// Compares a sight with lines to tip and hub, and to just above and below the least height seen.
  void expect_line(const Store& store, const DwellingFacade& facade, const Turbine& turbine, const TurbineSight& sight,
                   double leaf_area) {
    const auto clear = [&](double height) { return sees(store, facade, turbine, height, leaf_area); };
    EXPECT_EQ(sight.tip == Verdict::kVisible, clear(turbine.tip_height));
    if (turbine.hub_height) {
      EXPECT_EQ(sight.hub == Verdict::kVisible, clear(*turbine.hub_height));
    }
    if (sight.tip != Verdict::kVisible) return;
    const double least = turbine.tip_height - sight.visible;
    EXPECT_TRUE(clear(std::min(least + 0.02, turbine.tip_height))) << least;
    if (least > 0.03) {
      EXPECT_FALSE(clear(least - 0.03)) << least;
    }
  }

  /// Counts the sights that differ between woods that are solid and none, as all others are told without a walk.
  int expect_lines_agree(const Store& store, const DwellingsSurvey& found) {
    int between = 0;
    for (const Dwelling& dwelling : found.dwellings) {
      for (const DwellingFacade& facade : dwelling.facades) {
        for (std::size_t t = 0; t < 2; ++t) {
          if (facade.screened[t].tip == Verdict::kOutside) continue;
          const Turbine& turbine = found.request.turbines.turbines[t];
          expect_line(store, facade, turbine, facade.summer[t], profile::kLeavesOn);
          expect_line(store, facade, turbine, facade.winter[t], profile::kLeavesOff);
          EXPECT_LE(facade.screened[t].visible, facade.summer[t].visible + 1e-9);
          EXPECT_LE(facade.summer[t].visible, facade.winter[t].visible + 0.02);
          EXPECT_LE(facade.winter[t].visible, facade.bare[t].visible + 1e-9);
          between += facade.winter[t].visible > facade.screened[t].visible ? 1 : 0;
        }
      }
    }
    return between;
  }

  DwellingsRequest request_;
};

TEST_F(SightsOfSeasons, AreWhatSingleLinesSay) {
  const Store store(path());
  EXPECT_GT(expect_lines_agree(store, survey_dwellings(store, request_, progress_)), 3);
}

TEST_F(SightsOfSeasons, AreHiddenByHousesInAnySeason) {
  add_houses();
  const Store store(path());
  EXPECT_GT(expect_lines_agree(store, survey_dwellings(store, request_, progress_)), 0);
}

TEST_F(SightsOfSeasons, AreThoseOfSolidWoodsWhereNoneIsAmongTheThemes) {
  add_houses();
  request_.themes = ThemeChoice::parse("houses");
  const Store store(path());
  const DwellingsSurvey found = survey_dwellings(store, request_, progress_);
  for (const Dwelling& dwelling : found.dwellings)
    for (const DwellingFacade& facade : dwelling.facades)
      for (std::size_t t = 0; t < 2; ++t) {
        EXPECT_EQ(facade.summer[t].tip, facade.screened[t].tip);
        EXPECT_EQ(facade.winter[t].visible, facade.screened[t].visible);
      }
}

TEST_F(SightsOfSeasons, AreNotLookedForWithoutFoliageOrWhereNothingStands) {
  const Store store(path());
  DwellingsRequest solid = request_, bare = request_;
  solid.foliage.reset(), bare.themes = ThemeChoice::none();
  for (const DwellingsRequest& request : {solid, bare}) {
    const DwellingsSurvey found = survey_dwellings(store, request, progress_);
    EXPECT_TRUE(found.dwellings[0].facades[0].winter.empty());
    EXPECT_FALSE(view_of(found, found.dwellings[0], SightSurface::kWinter));
  }
}

TEST_F(SightsOfSeasons, RefuseFoliageThatMakesNoSense) {
  request_.foliage = {.extinction = -1, .least_transmittance = 0.5};
  EXPECT_THROW(survey_dwellings(Store(path()), request_, progress_), InputError);
}

}  // namespace
}  // namespace itin::viewshed
