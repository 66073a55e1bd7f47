// Zones of theoretical visibility against single exact lines of sight, and on hand-made ground.
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <gmock/gmock.h>
#include <iostream>
#include <random>
#include <set>
#include <sstream>
#include <string>
#include <tuple>

#include <gdal_priv.h>
#include <gtest/gtest.h>
#include <ogrsf_frmts.h>

#include <itin/degrees.hpp>
#include <itin/error.hpp>
#include <itin/parallel.hpp>
#include <viewshed/link_exclusion.hpp>
#include <viewshed/turbine_view.hpp>
#include <viewshed/turbines.hpp>
#include <viewshed/zone_files.hpp>

#include "support/exact_line_of_sight.hpp"
#include "support/real_terrain.hpp"
#include "support/seed.hpp"
#include "support/terrain_tin.hpp"
#include "turbines/farm_combinations.hpp"
#include "turbines/proposal.hpp"
#include "turbines/value_bands.hpp"

namespace itin::viewshed {
namespace {

using test::kCorner;

Turbine turbine(std::size_t number, double dx, double dy, const std::string& farm = "") {
  Turbine t;
  t.number = number, t.name = std::to_string(number), t.farm = farm;
  t.position = {kCorner.x + dx, kCorner.y + dy};
  t.tip_height = 120, t.hub_height = 70, t.rotor_diameter = 100, t.radius = 1500;
  return t;
}

Zone survey(const Tin& tin, const ZoneRequest& request, const Tin* screened = nullptr) {
  NoProgress progress;
  return survey_turbines(tin, screened, request, progress);
}

std::size_t cell_at(const Zone& zone, double dx, double dy) {
  return zone.grid.index(zone.grid.cell_at({kCorner.x + dx, kCorner.y + dy}).value());
}

bool sees(const Zone& zone, std::size_t cell, std::size_t number) {
  const RasterBit bit = turbine_bit(number);
  return (zone.bare.turbines[bit.grid * zone.grid.cell_count() + cell] & bit.mask) != 0;
}

/// A cell's values from single lines of sight, with the slow twin.
struct Expected {
  unsigned hubs = 0, tips = 0;
  double height = 0, angle = 0, sum = 0, nearest = INFINITY;
  bool grazes = false;  ///< a tip or hub so close to a silhouette that rounding decides
};

Expected expected(const test::ExactLineOfSight& exact, const Zone& zone, Point2 eye, double ground, std::size_t cell) {
  Expected e;
  const Point3 from{eye.x, eye.y, ground + zone.request.observer_height};
  for (std::size_t k = 0; k < zone.request.turbines.size(); ++k) {
    const Turbine& t = zone.request.turbines[k];
    const double d = std::hypot(t.position.x - eye.x, t.position.y - eye.y), base = zone.ground_m[k];
    if (d > t.radius) {
      EXPECT_FALSE(sees(zone, cell, t.number));
      continue;
    }
    const auto clearance = [&](double h) { return exact.clearance(from, {t.position.x, t.position.y, base + h}); };
    const auto visible = [&](double h) {
      if (std::abs(clearance(h)) < 2e-6 && h < t.tip_height) e.grazes = true;
      return clearance(h) >= -1e-6;
    };
    EXPECT_EQ(sees(zone, cell, t.number), visible(t.tip_height));
    if (!visible(t.tip_height)) continue;
    ++e.tips;
    if (visible(*t.hub_height)) ++e.hubs;
    double low = 0, high = t.tip_height;
    for (int i = 0; i < 60 && !(clearance(low) >= 0); ++i) {
      const double middle = (low + high) / 2;
      (clearance(middle) >= 0 ? high : low) = middle;
      if (high - low < 1e-7) low = high;
    }
    const double drop = zone.request.earth.drop(d);
    const auto above = [&](double h) { return in_degrees(std::atan((base + h - drop - from.z) / d)); };
    const double angle = above(t.tip_height) - above(low);
    e.height = std::max(e.height, t.tip_height - low), e.angle = std::max(e.angle, angle), e.sum += angle;
    e.nearest = std::min(e.nearest, d);
  }
  return e;
}

TEST(Turbines, AreSeenWholeFromTheirOwnPlace) {
  const Tin tin = test::fractal_tin(33, 50, 150, 0.5, test::seed());
  for (const double steps : {0.0, 1e-9, 1e-5, 0.4, 0.9}) {
    ZoneRequest request;
    request.cell_size = 3.37;
    const Point2 corner{std::floor(300700 / 3.37) * 3.37 + 1.685, std::floor(200900 / 3.37) * 3.37 + 1.685};
    request.turbines = {turbine(1, 0, 0)};
    request.turbines[0].position = {corner.x + steps * tin.grid.resolution, corner.y};
    request.turbines[0].radius = 100;
    const Zone zone = survey(tin, request);
    const std::size_t own = zone.grid.index(*zone.grid.cell_at(corner));
    EXPECT_EQ(zone.bare.tip_count[own], 1U) << steps;
    EXPECT_EQ(zone.bare.hub_count[own], 1U) << steps;
    EXPECT_FLOAT_EQ(zone.bare.visible_height_m[own], static_cast<float>(request.turbines[0].tip_height));
    EXPECT_EQ(zone.bare.vertical_angle_deg[own], 180);
    EXPECT_EQ(zone.bare.nearest_m[own], 0);
  }
}

TEST(Turbines, EveryValueFollowsFromSingleLinesOfSight) {
  const std::uint32_t seed = test::seed();
  const Tin tin = test::fractal_tin(33, 50, 150, 0.5, seed);
  ZoneRequest request;
  request.cell_size = 50;
  request.turbines = {turbine(1, 400, 500), turbine(2, 1210, 333), turbine(40, 800, 1400)};
  request.turbines[1].radius = 700;
  const Zone zone = survey(tin, request);
  ASSERT_EQ(zone.words, 2U);
  const test::ExactLineOfSight exact(tin, request.earth);
  int seen = 0;
  for (std::int64_t row = 0; row < zone.grid.rows(); row += 2) {
    for (std::int64_t column = 0; column < zone.grid.columns(); column += 2) {
      const Point2 eye = zone.grid.centre(column, row);
      const std::size_t i = zone.grid.index({column, row});
      const auto ground = exact.height(eye);
      if (zone.bare.tip_count[i] == kCountOutside) continue;
      ASSERT_TRUE(ground);
      const Expected e = expected(exact, zone, eye, *ground, i);
      if (e.grazes) continue;
      EXPECT_EQ(zone.bare.tip_count[i], e.tips);
      EXPECT_EQ(zone.bare.hub_count[i], e.hubs);
      EXPECT_NEAR(zone.bare.visible_height_m[i], e.height, 1e-3);
      EXPECT_NEAR(zone.bare.vertical_angle_deg[i], e.angle, 1e-3);
      EXPECT_NEAR(zone.bare.vertical_angle_sum_deg[i], e.sum, 1e-3);
      EXPECT_FLOAT_EQ(zone.bare.share[i], static_cast<float>(e.tips / 3.0));
      if (e.tips > 0) {
        EXPECT_NEAR(zone.bare.nearest_m[i], e.nearest, 1e-2);
      }
      seen += e.tips > 0 ? 1 : 0;
    }
  }
  EXPECT_GT(seen, 20);
}

std::string repd_path() {
  return std::string(ITIN_DATA_DIR) + "/wind-turbine-sites/UK_REPD-June-2020-update.csv";
}

/// Operational wind farms of Wales within a box, one turbine where the database has the farm.
std::vector<Turbine> repd_farms(const Box& box) {
  GDALAllRegister();
  const GDALDatasetUniquePtr file(GDALDataset::Open(repd_path().c_str(), GDAL_OF_VECTOR));
  std::vector<Turbine> farms;
  for (const auto& row : *file->GetLayer(0)) {
    const auto text = [&](const char* field) { return std::string(row->GetFieldAsString(field)); };
    const auto number = [&](const char* field) {
      std::string digits = text(field);
      std::erase(digits, ',');
      return std::atof(digits.c_str());
    };
    const Point2 at{number("X-coordinate"), number("Y-coordinate")};
    if (text("Technology Type") != "Wind Onshore" || text("Development Status (short)") != "Operational") continue;
    if (!box.contains(at) || number("Height of Turbines (m)") <= 0) continue;
    Turbine& t = farms.emplace_back();
    t.number = farms.size(), t.farm = text("Site Name"), t.position = at, t.radius = 12000;
    t.tip_height = number("Height of Turbines (m)"), t.hub_height = 0.6 * t.tip_height;
  }
  return farms;
}

TEST(Turbines, FarmsOfSouthWales) {
  const auto tin = test::pant_y_wal();
  if (!tin || !std::filesystem::exists(repd_path()))
    GTEST_SKIP() << "needs " << test::os_terrain_50_path() << " and " << repd_path();
  ZoneRequest request;
  request.turbines = repd_farms(tin->bounds());
  ASSERT_GE(request.turbines.size(), 2U);
  EXPECT_THAT(request.turbines[0].farm, ::testing::StartsWith("Pant y wal"));
  request.turbines.push_back(turbine(77, 0, 0, "planned"));
  request.turbines.back().position = {288500, 193200}, request.turbines.back().radius = 12000;
  request.cell_size = 400;
  const Zone zone = survey(*tin, request);
  EXPECT_THAT(farms_of(zone.request.turbines), ::testing::SizeIs(3));
  const test::ExactLineOfSight exact(*tin, request.earth);
  int seen = 0, hidden = 0;
  for (std::int64_t row = 2; row < zone.grid.rows(); row += 19) {
    for (std::int64_t column = 3; column < zone.grid.columns(); column += 19) {
      const Point2 eye = zone.grid.centre(column, row);
      const std::size_t cell = zone.grid.index({column, row});
      if (zone.bare.tip_count[cell] == kCountOutside) continue;
      const double height = exact.height(eye).value();
      for (std::size_t k = 0; k < zone.request.turbines.size(); ++k) {
        const Turbine& t = zone.request.turbines[k];
        if (std::hypot(t.position.x - eye.x, t.position.y - eye.y) > t.radius) continue;
        const Point3 tip{t.position.x, t.position.y, zone.ground_m[k] + t.tip_height};
        const double clearance = exact.clearance({eye.x, eye.y, height + request.observer_height}, tip);
        if (std::abs(clearance + 1e-6) < 1e-6) continue;
        EXPECT_EQ(sees(zone, cell, t.number), clearance > -1e-6) << eye.x << "," << eye.y << " " << t.farm;
        ++(clearance > -1e-6 ? seen : hidden);
      }
    }
  }
  EXPECT_GT(seen, 3);
  EXPECT_GT(hidden, 5);
}

TEST(Turbines, BehindAWallSimilarTrianglesTell) {
  // A wall 10 m high at 500 m; the eye 2 m up at 105 m, the turbine at 905 m.
  const Tin tin = test::lattice_tin(101, 21, 10, [](std::int32_t c, auto) { return c == 50 ? 10.0 : 0.0; });
  ZoneRequest request;
  request.cell_size = 10;
  request.earth = Earth::flat();
  request.turbines = {turbine(1, 905, 105)};
  const Zone zone = survey(tin, request);
  const std::size_t i = cell_at(zone, 105, 105);
  const double least = 2 + 8 * 800.0 / 395;
  EXPECT_NEAR(zone.bare.visible_height_m[i], 120 - least, 1e-3);
  EXPECT_NEAR(zone.bare.vertical_angle_deg[i], in_degrees(std::atan(118 / 800.0) - std::atan((least - 2) / 800)), 1e-4);
  EXPECT_EQ(zone.bare.hub_count[i], 1);
  EXPECT_FLOAT_EQ(zone.bare.nearest_m[i], 800);
  EXPECT_NEAR(zone.bare.horizontal_angle_deg[i], 2 * in_degrees(std::atan(50 / 800.0)), 1e-4);
  EXPECT_NEAR(zone.bare.horizontal_from_deg[i], 90 - in_degrees(std::atan(50 / 800.0)), 1e-4);
  EXPECT_FLOAT_EQ(zone.bare.visible_height_m[cell_at(zone, 705, 105)], 120);
}

TEST(Turbines, TheScreenedSurfaceHidesWhereFeaturesStandAndEyesStayOnTheGround) {
  const auto ground = test::lattice_tin(101, 21, 10, [](auto, auto) { return 0.0; });
  const auto screen = test::lattice_tin(101, 21, 10, [](std::int32_t c, auto) { return c == 50 ? 200.0 : 0.0; });
  ZoneRequest request;
  request.cell_size = 10;
  request.turbines = {turbine(1, 905, 105)};
  const Zone zone = survey(ground, request, &screen);
  ASSERT_TRUE(zone.screened);
  const std::size_t behind = cell_at(zone, 105, 105), before = cell_at(zone, 705, 105),
                    within = cell_at(zone, 495, 105);
  EXPECT_EQ(zone.bare.tip_count[behind], 1);
  EXPECT_EQ(zone.screened->tip_count[behind], 0);
  EXPECT_EQ(zone.screened->visible_height_m[behind], 0);
  EXPECT_TRUE(std::isnan(zone.screened->nearest_m[behind]));
  EXPECT_EQ(zone.screened->tip_count[before], 1);
  EXPECT_EQ(zone.screened->tip_count[within], 0) << "an eye under the feature's top";
}

TEST(Turbines, WithoutGroundAreMisplacedAndKeepTheirBits) {
  const Tin tin = test::lattice_tin(21, 21, 50, [](auto, auto) { return 0.0; });
  ZoneRequest request;
  request.cell_size = 50;
  request.turbines = {turbine(1, -900, 500), turbine(2, 500, 500)};
  const Zone zone = survey(tin, request);
  ASSERT_EQ(zone.misplaced.size(), 1U);
  EXPECT_EQ(zone.misplaced.front().number, 1U);
  EXPECT_THAT(zone.misplaced.front().message, ::testing::HasSubstr("no data"));
  const std::size_t i = cell_at(zone, 225, 225);
  EXPECT_FALSE(sees(zone, i, 1));
  EXPECT_TRUE(sees(zone, i, 2));
  request.turbines.pop_back();
  EXPECT_THROW(survey(tin, request), InputError);
}

TEST(Turbines, DoNotDependOnTheNumberOfThreads) {
  const Tin tin = test::fractal_tin(33, 50, 150, 0.5, 7);
  ZoneRequest request;
  request.cell_size = 20;
  for (std::size_t k = 1; k <= 12; ++k) request.turbines.push_back(turbine(k, 100.0 * static_cast<double>(k), 700));
  set_thread_count(1);
  const Zone one = survey(tin, request);
  set_thread_count(0);
  const Zone many = survey(tin, request);
  EXPECT_EQ(one.bare.turbines, many.bare.turbines);
  EXPECT_EQ(one.bare.vertical_angle_sum_deg.size(), many.bare.vertical_angle_sum_deg.size());
  for (std::size_t i = 0; i < one.bare.visible_height_m.size(); ++i) {
    const float a = one.bare.visible_height_m[i], b = many.bare.visible_height_m[i];
    ASSERT_TRUE(a == b || (std::isnan(a) && std::isnan(b)));
  }
}

TEST(Turbines, UnusableNumbersAreNamed) {
  const Tin tin = test::lattice_tin(5, 5, 50, [](auto, auto) { return 0.0; });
  ZoneRequest request;
  request.cell_size = 50;
  request.turbines = {turbine(3, 100, 100)};
  request.turbines[0].hub_height = 130;
  try {
    survey(tin, request);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("turbine 3"));
  }
  request.turbines[0].hub_height = 70;
  request.cell_size = 5000;
  EXPECT_THROW(survey(tin, request), InputError);
}

TEST(Turbines, RadarSeesWhatRisesAboveItsHorizon) {
  const Tin tin = test::lattice_tin(101, 21, 10, [](std::int32_t c, auto) { return c == 50 ? 10.0 : 0.0; });
  ZoneRequest request;
  request.cell_size = 10;
  request.earth = Earth::flat();
  request.turbines = {turbine(1, 905, 105), turbine(2, 305, 105)};
  request.radar = Observer{"radar", {kCorner.x + 105, kCorner.y + 105}, 2};
  const Zone zone = survey(tin, request);
  ASSERT_TRUE(zone.radar);
  const double least = 2 + 8 * 800.0 / 395;
  EXPECT_NEAR(zone.radar->height_m[cell_at(zone, 905, 105)], least, 1e-3);
  EXPECT_NEAR(zone.radar->height_m[cell_at(zone, 305, 105)], 0, 1e-3);
  EXPECT_NEAR(zone.radar->turbine_m[0], 120 - least, 1e-3);
  EXPECT_NEAR(zone.radar->turbine_m[1], 120, 1e-3);
}

TEST(RotorHorizon, HoldsAllArcsInTheSmallestOne) {
  const auto of = [](std::vector<Arc> arcs) { return rotor_horizon(arcs); };
  EXPECT_DOUBLE_EQ(of({{10, 5}}).held.width, 5);
  EXPECT_DOUBLE_EQ(of({{10, 5}}).held.from, 10);
  const RotorHorizon across = of({{5, 4}, {350, 4}});  // through north
  EXPECT_DOUBLE_EQ(across.held.from, 350);
  EXPECT_DOUBLE_EQ(across.held.width, 19);
  EXPECT_DOUBLE_EQ(across.occupied, 8);
  const RotorHorizon over = of({{358, 6}, {2, 6}});  // overlapping across north
  EXPECT_DOUBLE_EQ(over.held.from, 358);
  EXPECT_DOUBLE_EQ(over.held.width, 10);
  EXPECT_DOUBLE_EQ(over.occupied, 10);
  const RotorHorizon within = of({{100, 50}, {110, 5}});
  EXPECT_DOUBLE_EQ(within.held.width, 50);
  EXPECT_DOUBLE_EQ(within.occupied, 50);
  const RotorHorizon around = of({{0, 90}, {90, 90}, {180, 90}, {270, 90}});
  EXPECT_DOUBLE_EQ(around.held.width, 360);
  EXPECT_DOUBLE_EQ(around.occupied, 360);
}

TEST(RotorHorizon, AgreesWithCountingDegrees) {
  std::mt19937 random(11);
  for (int round = 0; round < 200; ++round) {
    std::vector<Arc> arcs;
    std::vector<bool> covered(360);
    for (unsigned n = 1 + random() % 6; n > 0; --n) {
      const unsigned from = random() % 360, width = 1 + random() % 40;
      arcs.push_back({static_cast<double>(from), static_cast<double>(width)});
      for (unsigned i = 0; i < width; ++i) covered[(from + i) % 360] = true;
    }
    int widest = 0, gap = 0;
    for (int i = 0; i < 720; ++i)
      widest = std::max(widest, gap = covered[static_cast<std::size_t>(i % 360)] ? 0 : gap + 1);
    const RotorHorizon horizon = rotor_horizon(arcs);
    EXPECT_NEAR(horizon.held.width, 360 - std::min(widest, 360), 1e-9);
    EXPECT_NEAR(horizon.occupied, static_cast<double>(std::count(covered.begin(), covered.end(), true)), 1e-9);
  }
}

TEST(Bands, HoldEveryValueOnce) {
  for (const std::size_t most : {1U, 5U, 7U, 8U, 75U, 500U}) {
    const auto bands = count_bands(most);
    EXPECT_LE(bands.size(), 8U);
    EXPECT_EQ(band_of(bands, 0), 0U);
    EXPECT_EQ(band_of(bands, 1), 1U);
    EXPECT_EQ(band_of(bands, static_cast<double>(most)), bands.size() - 1);
  }
  EXPECT_EQ(count_bands(75)[1].label, "1 - 11");
  EXPECT_EQ(band_of(limit_bands({10, 25}, "m"), 1000), 3U);
}

/// Cells of more turbines are darker, whatever is printed in grey.
TEST(Bands, DarkenFromFewToMany) {
  const auto light = [](const Rgba& c) { return 0.2126 * c.red + 0.7152 * c.green + 0.0722 * c.blue; };
  for (const std::size_t most : {1U, 2U, 5U, 75U}) {
    const auto bands = count_bands(most);
    for (std::size_t i = 2; i < bands.size(); ++i)
      EXPECT_LT(light(bands[i].colour), light(bands[i - 1].colour)) << most << ", band " << i;
  }
  const auto losses = loss_bands();
  for (std::size_t i = 1; i < losses.size(); ++i)
    EXPECT_GT(light(losses[i].colour), light(losses[i - 1].colour)) << losses[i].label;
}

/// Each turbine is in one group, and groups differ in colour.
TEST(TurbineGroups, AreFarmsOrElseStatuses) {
  using enum TurbineStatus;
  for (const std::size_t farms : {1U, 3U, 8U, 9U, 20U}) {
    std::vector<Turbine> turbines;
    for (std::size_t n = 1; n <= 2 * farms; ++n) {
      turbines.push_back(turbine(n, 100.0 * static_cast<double>(n), 0, "F" + std::to_string(n % farms)));
      turbines.back().status = n % farms == 1 % farms ? kProposed : kExisting;
    }
    const std::vector<TurbineGroup> groups = turbine_groups(turbines);
    EXPECT_EQ(groups.size(), farms <= 8 ? farms : 2U);
    std::set<std::tuple<int, int, int>> colours;
    std::set<std::size_t> grouped;
    for (const TurbineGroup& group : groups) {
      colours.insert({group.colour.red, group.colour.green, group.colour.blue});
      for (const std::size_t t : group.turbines) {
        EXPECT_TRUE(grouped.insert(t).second);
        const std::string status = turbines[t].status == kProposed ? "roposed" : "xisting";
        EXPECT_THAT(group.name, ::testing::EndsWith(status));
        EXPECT_THAT(group.name, ::testing::StartsWith(farms <= 8 ? turbines[t].farm + ", " : ""));
      }
    }
    EXPECT_EQ(colours.size(), groups.size());
    EXPECT_EQ(grouped.size(), turbines.size());
  }
}

TEST(TurbineGroups, HaveNoStatusThatIsNotOfAll) {
  std::vector<Turbine> turbines{turbine(1, 0, 0, "A"), turbine(2, 100, 0, "A"), turbine(3, 200, 0, "")};
  turbines[0].status = TurbineStatus::kProposed;
  const std::vector<TurbineGroup> groups = turbine_groups(turbines);
  ASSERT_EQ(groups.size(), 2U);
  EXPECT_EQ(groups[0].name, "A");
  EXPECT_EQ(groups[1].name, "");
}

/// Of few farms the value is their bits, of many a number; it always has the name of those whose tips are seen.
TEST(FarmCombinations, NameTheFarmsSeenHoweverMany) {
  const Tin tin = test::fractal_tin(33, 50, 400, 0.5, 5);
  for (const std::size_t farms : {3U, 9U, 40U}) {
    ZoneRequest request;
    request.cell_size = 50;
    for (std::size_t n = 1; n <= farms + 5; ++n)
      request.turbines.push_back(turbine(n, 30.0 * static_cast<double>(1 + n * 7 % 40),
                                         30.0 * static_cast<double>(1 + n * 11 % 45), "F" + std::to_string(n % farms)));
    const Zone zone = survey(tin, request);
    const std::vector<std::string> names = farms_of(zone.request.turbines);
    ASSERT_EQ(names.size(), farms);
    const std::vector<std::uint32_t> values = farm_combinations(zone, zone.bare);
    const std::vector<Combination> present = combinations_present(zone, {&values});
    std::set<std::string> found;
    for (std::size_t i = 0; i < values.size(); ++i) {
      ASSERT_EQ(values[i] == kOutsideFarms, zone.bare.tip_count[i] == kCountOutside);
      if (values[i] == kOutsideFarms) continue;
      std::string expected;
      for (const std::string& farm : names) {
        bool seen = false;
        for (const Turbine& t : zone.request.turbines) {
          const RasterBit bit = turbine_bit(t.number);
          seen =
              seen || (t.farm == farm && (zone.bare.turbines[bit.grid * zone.grid.cell_count() + i] & bit.mask) != 0);
        }
        if (seen) expected += (expected.empty() ? "" : " + ") + farm;
      }
      const auto combination =
          std::find_if(present.begin(), present.end(), [&](const Combination& c) { return c.farms == values[i]; });
      ASSERT_NE(combination, present.end());
      EXPECT_EQ(combination->name, expected.empty() ? "none" : expected);
      EXPECT_EQ(values[i] == 0, expected.empty());
      found.insert(combination->name);
    }
    EXPECT_EQ(found.size(), present.size());
    EXPECT_GT(found.size(), 2U);
    const std::string table = combination_table(zone);
    EXPECT_EQ(static_cast<std::size_t>(std::count(table.begin(), table.end(), '\n')), 1 + present.size());
  }
}

TEST(Proposal, BoundsTheStudyAreaAndTellsWhatItAddsToTheOthers) {
  const Tin tin = test::fractal_tin(33, 50, 150, 0.5, 9);
  ZoneRequest request;
  request.cell_size = 60;
  request.turbines = {turbine(1, 400, 420), turbine(2, 1150, 700), turbine(3, 620, 1190), turbine(4, 480, 560)};
  for (Turbine& t : request.turbines) t.radius = 700, t.tip_height = 60, t.hub_height = 35, t.rotor_diameter = 50;
  request.turbines[0].status = request.turbines[3].status = TurbineStatus::kProposed;
  request.turbines[1].status = TurbineStatus::kConsented, request.turbines[2].status = TurbineStatus::kExisting;
  ASSERT_TRUE(has_proposal(request));
  const Zone zone = survey(tin, request);
  ZoneRequest all = request;
  all.cell_size.reset(), all.grid = zone.grid;
  for (Turbine& t : all.turbines) t.status.reset();
  ASSERT_FALSE(has_proposal(all));
  const Zone cumulative = survey(tin, all);
  const std::vector<std::uint16_t> own = proposed_tips(zone, zone.bare);
  const std::vector<std::uint8_t> added = additions(zone, zone.bare);
  std::array<std::size_t, kAdditions.size()> cells{};
  std::size_t outside = 0;
  for (std::int64_t row = 0; row < zone.grid.rows(); ++row) {
    for (std::int64_t column = 0; column < zone.grid.columns(); ++column) {
      const std::size_t cell = zone.grid.index({column, row});
      const Point2 centre = zone.grid.centre(column, row);
      const auto within = [&](const Turbine& t) {
        return std::hypot(centre.x - t.position.x, centre.y - t.position.y) <= t.radius;
      };
      if (!within(request.turbines[0]) && !within(request.turbines[3])) {
        EXPECT_EQ(zone.bare.tip_count[cell], kCountOutside);
        EXPECT_TRUE(std::isnan(zone.bare.share[cell]));
        EXPECT_EQ(added[cell], kNoAddition);
        outside += cumulative.bare.tip_count[cell] != kCountOutside;
        continue;
      }
      EXPECT_EQ(zone.bare.tip_count[cell], cumulative.bare.tip_count[cell]);
      EXPECT_EQ(zone.bare.hub_count[cell], cumulative.bare.hub_count[cell]);
      if (zone.bare.tip_count[cell] == kCountOutside) continue;
      EXPECT_EQ(own[cell], sees(zone, cell, 1) + sees(zone, cell, 4));
      const bool others = sees(zone, cell, 2) || sees(zone, cell, 3);
      using enum Addition;
      const Addition expected = own[cell] > 0 ? (others ? kBoth : kProposalAlone) : (others ? kOthersAlone : kNone);
      EXPECT_EQ(added[cell], static_cast<std::uint8_t>(expected));
      ++cells[added[cell]];
    }
  }
  EXPECT_GT(outside, 0U);
  for (const std::size_t count : cells) EXPECT_GT(count, 0U);
}

TEST(Areas, SumUpToTheCellsWithAValue) {
  const Tin tin = test::fractal_tin(33, 50, 150, 0.5, 3);
  ZoneRequest request;
  request.cell_size = 50;
  request.turbines = {turbine(1, 400, 500, "A"), turbine(2, 1200, 900, "B")};
  const Zone zone = survey(tin, request);
  std::istringstream table(area_table(zone));
  std::string line;
  std::getline(table, line);
  EXPECT_EQ(line,
            "surface,seen,band,ring_from_km,ring_to_km,area_km2,share_of_ring_with_data_percent,ring_with_data_percent,"
            "undecided_km2");
  double hub = 0, tip = 0;
  while (std::getline(table, line)) {
    std::vector<std::string> cells;
    std::istringstream row(line);
    for (std::string cell; std::getline(row, cell, ',');) cells.push_back(cell);
    ASSERT_EQ(cells.size(), 9U);
    EXPECT_EQ(std::stod(cells[8]), 0);
    (cells[1] == "hub" ? hub : tip) += std::stod(cells[5]);
  }
  const auto cells = std::count_if(zone.bare.tip_count.begin(), zone.bare.tip_count.end(),
                                   [](std::uint16_t n) { return n != kCountOutside; });
  EXPECT_NEAR(hub, static_cast<double>(cells) * 0.0025, 1e-4);
  EXPECT_NEAR(tip, hub, 1e-9);
  EXPECT_THAT(farms_of(zone.request.turbines), ::testing::ElementsAre("A", "B"));
}

TEST(LinkExclusion, FollowsBaconsRadius) {
  // ../shared/radio-and-wind.md: 20.7 m at 7 GHz and 38.7 m at 2 GHz in the middle of 20 km.
  EXPECT_NEAR(second_fresnel_radius_m(10000, 10000, 7), 20.7, 0.05);
  EXPECT_NEAR(second_fresnel_radius_m(10000, 10000, 2), 38.7, 0.05);
  const RadioLink link{"l", {0, 0}, {20000, 0}};
  EXPECT_NEAR(link_clearance_m(link, {10000, 100}, 7, 50), 100 - 20.69 - 50, 0.02);
  EXPECT_NEAR(link_clearance_m(link, {-30, 40}, 7, 10), 40, 1e-9);
  const RasterGrid grid({0, 500}, 10, 10, 2000, 100);
  const auto excluded = link_exclusion(grid, {link}, 7, 50);
  EXPECT_EQ(excluded[grid.index(*grid.cell_at({10000, 65}))], kLinkExcluded);
  EXPECT_EQ(excluded[grid.index(*grid.cell_at({10000, 85}))], kLinkClear);
}

}  // namespace
}  // namespace itin::viewshed
