// Sight through woods: known answers, many small steps along random lines, and what must hold of any wood.
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include <itin/error.hpp>
#include <itin/feature_at.hpp>
#include <itin/import.hpp>
#include <itin/store.hpp>
#include <itin/triangulate.hpp>
#include <itin/wood_loss.hpp>
#include <profile/foliage.hpp>
#include <profile/path_profiles.hpp>

#include "support/rolling_hill.hpp"

namespace itin::profile {
namespace {

TEST(WoodLoss, HasTheKnownAnswers) {
  EXPECT_NEAR(*wood_loss_db(949, 50), 7.27, 0.005);
  EXPECT_NEAR(*wood_loss_db(2117.5, 100), 21.52, 0.005);
  EXPECT_NEAR(*wood_loss_db(105.9, 1e6), 9.4, 1e-9);
  EXPECT_EQ(*wood_loss_db(466.475, 0), 0);
  EXPECT_GT(*wood_loss_db(700, 50), *wood_loss_db(466.475, 50));
  EXPECT_LT(*wood_loss_db(700, 50), *wood_loss_db(949, 50));
  EXPECT_FALSE(wood_loss_db(105, 50));
  EXPECT_FALSE(wood_loss_db(2400, 50));
}

/// A surface of points (distance, elevation, theme).
Profile surface_of(const std::vector<std::tuple<double, double, int>>& points) {
  Profile surface;
  for (const auto& [distance, z, theme] : points) {
    ProfilePoint p;
    p.distance_m = distance, p.x = distance, p.ground_m = z, p.theme = static_cast<std::uint16_t>(theme);
    surface.points.push_back(p);
  }
  surface.length_m = surface.points.back().distance_m;
  return surface;
}

TEST(FoliageAlong, IsWhereTheLineIsBelowTheTops) {
  // A wood from 40 to 60 m, 10 m high; a house from 70 to 80.
  const Profile surface = surface_of({{0, 0, 0},
                                      {40, 0, 0},
                                      {40, 10, 2},
                                      {60, 10, 2},
                                      {60, 0, 0},
                                      {70, 0, 0},
                                      {70, 9, 1},
                                      {80, 9, 1},
                                      {80, 0, 0},
                                      {100, 0, 0}});
  const std::vector<bool> woods{false, false, true};
  const auto level = foliage_along(surface, {5, 5}, Earth::flat(), woods);
  ASSERT_EQ(level.size(), 1U);
  EXPECT_DOUBLE_EQ(level[0].from_m, 40);
  EXPECT_DOUBLE_EQ(level[0].to_m, 60);
  EXPECT_DOUBLE_EQ(level[0].length_m, 20);
  EXPECT_EQ(level[0].theme, 2);
  // From 0 to 20 m the line passes the tops at 50 m, and is longer than its plan.
  const auto rising = foliage_along(surface, {0, 20}, Earth::flat(), woods);
  ASSERT_EQ(rising.size(), 1U);
  EXPECT_NEAR(rising[0].to_m, 50, 1e-9);
  EXPECT_NEAR(rising[0].length_m, 10 * std::hypot(1, 0.2), 1e-9);
  EXPECT_TRUE(foliage_along(surface, {10, 10}, Earth::flat(), woods).empty());
  EXPECT_TRUE(foliage_along(surface, {5, 5}, Earth::flat(), {false, false, false}).empty());
}

/// 60 x 60 posts every 10 m from (300000, 199400), with woods that have leaf areas of their own, and houses.
class ThroughFoliage : public test::RollingHill {
 protected:
  void add_woods(const std::string& theme, int count) {
    std::vector<test::LineFeature> woods;
    for (int i = 0; i < count; ++i) {
      const double x = in(300010, 300480), y = in(199420, 199900);
      woods.push_back(test::box(x, y, x + in(10, 90), y + in(10, 90), in(4, 15)));
      woods.back().properties = fmt::format(R"({{"h":{:.2f},"lad":{:.2f}}})", in(4, 15), in(0, 0.02));
    }
    import_woods(theme, woods);
  }
  StoreLine line() {
    return {.from = {in(300010, 300580), in(199420, 199980)},
            .to = {in(300010, 300580), in(199420, 199980)},
            .themes = ThemeChoice::all()};
  }
  LosQuery query() {
    LosQuery query;
    query.from_height_m = in(6, 20), query.to_height_m = in(6, 20);
    return query;
  }
};

TEST_F(ThroughFoliage, EqualsManySmallSteps) {
  add_woods("woods", 12);
  add_houses();
  const Store store(path());
  int through = 0;
  for (int i = 0; i < 40; ++i) {
    const StoreLine l = line();
    const FoliageSight sight = through_foliage(store, l, query(), {.extinction = 0.5, .leaf_area = 0.02});
    if (sight.solid.verdict != SightVerdict::kVisible) {
      EXPECT_EQ(sight.verdict, SightVerdict::kHidden);
      continue;
    }
    constexpr int kSteps = 20000;
    std::vector<Point2> places;
    for (int k = 0; k < kSteps; ++k) {
      const double t = (k + 0.5) / kSteps;
      places.push_back({l.from.x + t * (l.to.x - l.from.x), l.from.y + t * (l.to.y - l.from.y)});
    }
    const auto tops = heights_at(store, places, Detail::tolerance(0), ThemeChoice::all(), progress_);
    const auto solid = heights_at(store, places, Detail::tolerance(0), ThemeChoice::parse("houses"), progress_);
    const double length = std::hypot(l.to.x - l.from.x, l.to.y - l.from.y), drop = Earth().drop_coefficient();
    const double a = sight.solid.antennas.from_m, b = sight.solid.antennas.to_m;
    double within = 0;
    for (int k = 0; k < kSteps; ++k) {
      const double t = (k + 0.5) / kSteps;
      const double ray = a + t * (b - a) - drop * length * length * t * (1 - t);
      if (ray < *tops[static_cast<std::size_t>(k)] &&
          *tops[static_cast<std::size_t>(k)] > *solid[static_cast<std::size_t>(k)] + 0.05)
        within += std::hypot(length, b - a) / kSteps;
    }
    EXPECT_NEAR(sight.length_m, within, 1 + length / 1000);
    EXPECT_NEAR(sight.transmittance, std::exp(-0.5 * 0.02 * sight.length_m), 1e-9);
    EXPECT_EQ(sight.verdict == SightVerdict::kVisible, sight.transmittance >= 0.5);
    through += sight.length_m > 1 ? 1 : 0;
  }
  EXPECT_GT(through, 1);
}

TEST_F(ThroughFoliage, LosesLightToMoreWoodAndGainsItByFelling) {
  add_woods("first", 8);
  add_houses();
  std::vector<StoreLine> lines;
  std::vector<LosQuery> queries;
  // So many that some of them lose light, whatever the seed.
  for (int i = 0; i < 90; ++i) lines.push_back(line()), queries.push_back(query());
  const Foliage sparse{.leaf_area = 0.02};
  std::vector<double> before;
  {
    const Store store(path());
    for (std::size_t i = 0; i < lines.size(); ++i)
      before.push_back(through_foliage(store, lines[i], queries[i], sparse).transmittance);
  }
  add_woods("second", 8);
  const Store store(path());
  const std::vector<FeatureNumber> all = woods_of(store), some = with_even_numbers(all);
  const ThemeChoice felled = without_features(store, ThemeChoice::all(), some, progress_),
                    cleared = without_features(store, ThemeChoice::all(), all, progress_);
  double lost = 0, gained = 0;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    StoreLine l = lines[i];
    const double more = through_foliage(store, l, queries[i], sparse).transmittance;
    EXPECT_LE(more, before[i] + 1e-3);
    l.themes = felled;
    const double less = through_foliage(store, l, queries[i], sparse).transmittance;
    EXPECT_GE(less, more - 1e-3);
    l.themes = cleared;
    const FoliageSight bare = through_foliage(store, l, queries[i], sparse);
    EXPECT_NEAR(bare.length_m, 0, 0.5);
    lost += before[i] - more, gained += less - more;
  }
  EXPECT_GT(lost, 0);
  EXPECT_GT(gained, 0);
}

TEST_F(ThroughFoliage, TakesLeafAreasOfFeatures) {
  add_woods("woods", 12);
  const Store store(path());
  int varied = 0;
  for (int i = 0; i < 30; ++i) {
    const StoreLine l = line();
    const LosQuery q = query();
    const FoliageSight sight = through_foliage(store, l, q, {.leaf_area = 0.01, .leaf_area_field = "lad"});
    const double most = std::exp(-0.5 * 0.02 * sight.length_m);
    EXPECT_GE(sight.transmittance, most - 1e-9);
    EXPECT_LE(sight.transmittance, 1);
    varied += sight.transmittance > most + 1e-3 && sight.transmittance < 1 - 1e-3 ? 1 : 0;
  }
  EXPECT_GT(varied, 0);
  const auto refused = [&](const Foliage& foliage) {
    EXPECT_THROW(through_foliage(store, line(), query(), foliage), InputError);
  };
  refused({.leaf_area_field = "none"});
  refused({.leaf_area = -1});
  refused({.extinction = -0.5});
  refused({.least_transmittance = 1.5});
}

/// Woods on a path with a corner, which keeps to the ground.
class FoliageOnPaths : public test::RollingHill {
 protected:
  PathFoliage on_path(const Foliage& foliage, const ThemeChoice& themes = ThemeChoice::all()) {
    PathQuery query{.corners = {{300050, 199900}, {300350, 199900}, {300350, 199600}}, .themes = themes};
    query.foliage = foliage;
    return *profiles_along(Store(path()), query, progress_).profiles.front().foliage;
  }
};

TEST_F(FoliageOnPaths, IsAsLongAsTheWoodsAreWide) {
  add_houses();
  test::LineFeature thin = test::box(300100, 199850, 300140, 199950, 12),
                    dense = test::box(300300, 199700, 300400, 199760, 8);
  test::import_raised(path(), directory_.file("woods.geojson"), ThemeKind::Vegetation, "woods", {thin, dense});
  const PathFoliage leaves = on_path({.leaf_area = kLeavesOn}, ThemeChoice::parse("woods"));
  ASSERT_EQ(leaves.stretches.size(), 2U);
  EXPECT_NEAR(leaves.stretches[0].from_m, 50, 0.02);
  EXPECT_NEAR(leaves.stretches[0].to_m, 90, 0.02);
  EXPECT_NEAR(leaves.stretches[1].from_m, 300 + 140, 0.02);
  EXPECT_NEAR(leaves.length_m, 40 + 60, 0.03);
  EXPECT_NEAR(std::log(leaves.transmittance), -0.5 * leaves.length_m, 1e-9);
  EXPECT_NEAR(std::log(on_path({.leaf_area = kLeavesOff}).transmittance), -0.05 * leaves.length_m, 0.01);
  EXPECT_TRUE(on_path({}, ThemeChoice::none()).stretches.empty());
  EXPECT_EQ(on_path({}, ThemeChoice::none()).transmittance, 1);
  EXPECT_THROW(on_path({.extinction = -1}), InputError);
}

TEST_F(FoliageOnPaths, TakesLeafAreasOfFeatures) {
  test::LineFeature thin = test::box(300100, 199850, 300140, 199950, 12),
                    dense = test::box(300140, 199850, 300160, 199950, 12);
  thin.properties = R"({"h":12,"lad":0.01})", dense.properties = R"({"h":12,"lad":0.2})";
  import_woods("woods", {thin, dense});
  EXPECT_NEAR(on_path({.leaf_area_field = "lad"}).transmittance, std::exp(-0.5 * (40 * 0.01 + 20 * 0.2)), 1e-3);
}

}  // namespace
}  // namespace itin::profile
