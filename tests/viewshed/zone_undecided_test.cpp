// What ground without data leaves undecided in zones of visibility, against a viewshed of each turbine and against the
// rules that decide it.
#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <sstream>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <itin/tin_heights.hpp>
#include <viewshed/turbines.hpp>
#include <viewshed/zone_files.hpp>
#include <viewshed/zone_maps.hpp>

#include "support/real_terrain.hpp"
#include "support/same_zone.hpp"
#include "support/seed.hpp"
#include "support/terrain_tin.hpp"
#include "support/viewshed_of.hpp"

namespace itin::viewshed {
namespace {

constexpr std::int32_t kHillPosts = 65;
constexpr double kHillStep = 50;

/// Hills with round lakes of no data, some of which reach the edge.
Tin holed_hills(std::mt19937& random) {
  const std::vector<double> z = test::fractal_heights(kHillPosts, 150, 0.5, random());
  struct Lake {
    double column, row, radius;
  };
  std::vector<Lake> lakes;
  for (int i = 0; i < 6; ++i)
    lakes.push_back({static_cast<double>(random() % kHillPosts), static_cast<double>(random() % kHillPosts),
                     1.5 + static_cast<double>(random() % 5)});
  return test::lattice_tin(kHillPosts, kHillPosts, kHillStep, [&](std::int32_t c, std::int32_t r) {
    for (const Lake& lake : lakes)
      if (std::hypot(c - lake.column, r - lake.row) < lake.radius) return std::nan("");
    return z[static_cast<std::size_t>(r) * kHillPosts + static_cast<std::size_t>(c)];
  });
}

ZoneRequest farms_on(const Tin& tin, std::mt19937& random) {
  std::uniform_real_distribution<double> share(0.05, 0.95);
  ZoneRequest request;
  request.cell_size = 40;
  while (request.turbines.size() < 4) {
    Turbine t;
    t.number = request.turbines.size() + 1, t.farm = t.number < 3 ? "A" : "B";
    t.position = {test::kCorner.x + share(random) * kHillPosts * kHillStep,
                  test::kCorner.y + share(random) * kHillPosts * kHillStep};
    t.tip_height = 90, t.hub_height = 30, t.rotor_diameter = 60;
    t.radius = 900 + 700 * static_cast<double>(t.number);
    if (height_on(tin, t.position)) request.turbines.push_back(t);
  }
  return request;
}

Zone survey_under(NoData rule, const Tin& tin, ZoneRequest request, const Tin* screened = nullptr) {
  NoProgress progress;
  request.nodata = rule;
  return survey_turbines(tin, screened, request, progress);
}

/// The slow way: whose verdicts of the cell's eye, seen from one turbine after another at this height, are as given.
std::vector<std::uint16_t> turbines_with(Verdict verdict, double Turbine::*height, const Tin& tin, const Zone& zone) {
  std::vector<std::uint16_t> counts(zone.grid.cell_count(), kCountOutside);
  for (const Turbine& t : zone.request.turbines) {
    Request request;
    request.observers = {{"turbine", t.position, t.*height}};
    request.target_height = zone.request.observer_height;
    request.radius = t.radius;
    request.grid = zone.grid;
    const Result result = test::run(tin, request);
    for (std::size_t i = 0; i < counts.size(); ++i) {
      if (result.visible[i] == Verdict::kOutside) continue;
      if (counts[i] == kCountOutside) counts[i] = 0;
      if (result.visible[i] == verdict) ++counts[i];
    }
  }
  return counts;
}

TEST(ZoneUndecided, FollowsFromAViewshedOfEachTurbine) {
  std::mt19937 random(test::seed());
  std::uint64_t undecided = 0;
  for (int round = 0; round < 4; ++round) {
    const Tin tin = holed_hills(random);
    ZoneRequest request = farms_on(tin, random);
    const Zone zone = survey_under(NoData::kUnknown, tin, request);
    EXPECT_TRUE(zone.warnings.empty());
    if (!zone.leaves_open()) continue;
    EXPECT_EQ(zone.bare.tip_count, turbines_with(Verdict::kVisible, &Turbine::tip_height, tin, zone));
    EXPECT_EQ(zone.bare.tip_undecided, turbines_with(Verdict::kUndecided, &Turbine::tip_height, tin, zone));
    // Hubs as turbines that end there.
    Zone hubs = zone;
    for (Turbine& t : hubs.request.turbines) t.tip_height = *t.hub_height;
    EXPECT_EQ(zone.bare.hub_count, turbines_with(Verdict::kVisible, &Turbine::tip_height, tin, hubs));
    EXPECT_EQ(zone.bare.hub_undecided, turbines_with(Verdict::kUndecided, &Turbine::tip_height, tin, hubs));
    for (const std::uint16_t n : zone.bare.hub_undecided) undecided += n == kCountOutside ? 0 : n;
  }
  EXPECT_GT(undecided, 100U);
}

/// Expects what is certainly seen to be what blocks, and what is undecided to be what clear ground would add.
void expect_between_the_rules(const Zone& unknown, const Zone& block, const Zone& clear) {
  const auto expect_between = [](const Visibility& open, Visibility blocked, const Visibility& passed) {
    ASSERT_TRUE(blocked.tip_undecided.empty());
    ASSERT_TRUE(passed.tip_undecided.empty());
    ASSERT_EQ(open.tip_undecided.size(), passed.tip_count.size());
    for (std::size_t i = 0; i < passed.tip_count.size(); ++i) {
      if (passed.tip_count[i] == kCountOutside) {
        ASSERT_EQ(open.tip_undecided[i], kCountOutside);
        ASSERT_EQ(open.hub_undecided[i], kCountOutside);
        continue;
      }
      ASSERT_EQ(open.tip_count[i] + open.tip_undecided[i], passed.tip_count[i]) << "cell " << i;
      ASSERT_EQ(open.hub_count[i] + open.hub_undecided[i], passed.hub_count[i]) << "cell " << i;
    }
    blocked.tip_undecided = open.tip_undecided, blocked.hub_undecided = open.hub_undecided;
    test::expect_same(open, blocked);
  };
  expect_between(unknown.bare, block.bare, clear.bare);
  ASSERT_EQ(unknown.screened.has_value(), block.screened.has_value());
  if (unknown.screened) expect_between(*unknown.screened, *block.screened, *clear.screened);
}

/// With houses as heights of the same posts.
TEST(ZoneUndecided, IsWhatTheRulesDecide) {
  std::mt19937 random(test::seed());
  int open = 0;
  for (int round = 0; round < 4; ++round) {
    const Tin tin = holed_hills(random);
    Tin built = tin;
    for (GridPoint& p : built.vertices)
      if (random() % 9 == 0) p.z += 3000;
    ZoneRequest request = farms_on(tin, random);
    const Zone unknown = survey_under(NoData::kUnknown, tin, request, &built);
    if (!unknown.leaves_open()) continue;
    for (std::size_t i = 0; i < unknown.grid.cell_count(); ++i) request.weights.push_back(random() % 7);
    request.grid = unknown.grid, request.cell_size.reset();
    const auto under = [&](NoData rule) { return survey_under(rule, tin, request, &built); };
    expect_between_the_rules(under(NoData::kUnknown), under(NoData::kBlock), under(NoData::kClear));
    ++open;
  }
  EXPECT_GT(open, 0);
}

TEST(ZoneUndecided, AcrossTheSeaAboutTenby) {
  const auto tin = test::tenby();
  if (!tin) GTEST_SKIP() << "needs " << test::os_terrain_50_path();
  ZoneRequest request;
  request.cell_size = 100;
  for (const Point2 place : {Point2{214200, 200800}, {212000, 203500}, {218000, 206000}}) {
    Turbine t;
    t.number = request.turbines.size() + 1, t.position = place, t.radius = 9000;
    t.tip_height = 120, t.hub_height = 70, t.rotor_diameter = 100;
    request.turbines.push_back(t);
  }
  const Zone zone = survey_under(NoData::kUnknown, *tin, request);
  EXPECT_EQ(zone.bare.tip_count, turbines_with(Verdict::kVisible, &Turbine::tip_height, *tin, zone));
  EXPECT_EQ(zone.bare.tip_undecided, turbines_with(Verdict::kUndecided, &Turbine::tip_height, *tin, zone));
  expect_between_the_rules(zone, survey_under(NoData::kBlock, *tin, request),
                           survey_under(NoData::kClear, *tin, request));
  const auto open = std::count_if(zone.bare.tip_undecided.begin(), zone.bare.tip_undecided.end(),
                                  [](std::uint16_t n) { return n > 0 && n != kCountOutside; });
  EXPECT_GT(open, 50);
}

TEST(ZoneUndecided, IsNothingWhereNoLineCrossesMissingGround) {
  std::mt19937 random(test::seed());
  const Tin whole = test::fractal_tin(kHillPosts, kHillStep, 150, 0.5, random());
  EXPECT_TRUE(survey_under(NoData::kUnknown, whole, farms_on(whole, random)).bare.tip_undecided.empty());
  // A strip without data, beyond the turbine's radius and within it.
  const Tin parted = test::lattice_tin(
      41, 41, 10, [](std::int32_t c, std::int32_t) { return c == 21 || c == 22 ? std::nan("") : 100.0; });
  ZoneRequest request;
  request.cell_size = 10;
  Turbine t;
  t.position = {test::kCorner.x + 105, test::kCorner.y + 205}, t.tip_height = 100, t.radius = 90;
  request.turbines = {t};
  EXPECT_FALSE(survey_under(NoData::kUnknown, parted, request).leaves_open());
  request.turbines[0].radius = 300;
  const Zone zone = survey_under(NoData::kUnknown, parted, request);
  const auto at = [&](double dx) { return zone.grid.index(*zone.grid.cell_at({t.position.x + dx, t.position.y})); };
  EXPECT_EQ(zone.bare.tip_undecided[at(0)], 0);
  EXPECT_EQ(zone.bare.tip_undecided[at(190)], 1);
  EXPECT_EQ(zone.bare.tip_count[at(190)], 0);
  EXPECT_EQ(zone.bare.tip_undecided[at(110)], kCountOutside);
}

/// Returns the label of a cell's class on the radar's map, from the limits that the legend states; empty outside.
std::string class_by_limits(const Zone& zone, std::size_t cell) {
  if (zone.bare.tip_count[cell] == kCountOutside) return "";
  const RadarView& radar = *zone.radar;
  const float seen = radar.height_m[cell];
  if (seen == 0) return "the ground itself";
  float from = 0;
  for (const float to : {25.0F, 50.0F, 75.0F, 100.0F, 150.0F, 200.0F, 500.0F, 1000.0F}) {
    if (seen <= to) return fmt::format("{:g} - {:g} m", from, to);
    from = to;
  }
  const bool open = radar.leaves_open() && !std::isnan(radar.undecided_height_m[cell]);
  return open ? "Undecided, across ground without data" : "None up to 1000 m";
}

/// Compares the radar's map with its heights, and returns how many classes it has cells of.
std::size_t classes_on_map(const Zone& zone) {
  const ZoneMap map = radar_map(zone).value();
  std::map<std::string, std::uint64_t> cells;
  for (std::size_t cell = 0; cell < map.class_of_cell.size(); ++cell) {
    const std::uint8_t c = map.class_of_cell[cell];
    const std::string label = c == kNoMapClass ? "" : map.classes[c].label;
    EXPECT_EQ(label, class_by_limits(zone, cell)) << zone.radar->height_m[cell];
    ++cells[label];
  }
  cells.erase("");
  for (const ZoneMap::Class& c : map.classes) EXPECT_EQ(c.cells, cells[c.label]) << c.label;
  return static_cast<std::size_t>(std::ranges::count_if(cells, [](const auto& c) { return c.second > 0; }));
}

/// What a radar may see behind missing ground is what it sees across clear ground, and not if that blocks.
TEST(ZoneUndecided, HoldsWhatARadarMaySee) {
  std::mt19937 random(test::seed());
  std::size_t open_cells = 0, open_turbines = 0, classes = 0;
  for (int round = 0; round < 16; ++round) {
    const Tin tin = holed_hills(random);
    ZoneRequest request = farms_on(tin, random);
    request.cell_size = 80;
    EXPECT_FALSE(radar_map(survey_under(NoData::kUnknown, tin, request)));
    request.radar = Observer{"radar", request.turbines.front().position, 15};
    const Zone zone = survey_under(NoData::kUnknown, tin, request);
    classes = std::max(classes, classes_on_map(zone));
    const RadarView unknown = *zone.radar, block = *survey_under(NoData::kBlock, tin, request).radar,
                    clear = *survey_under(NoData::kClear, tin, request).radar;
    test::expect_same(unknown.height_m, block.height_m);
    EXPECT_EQ(unknown.turbine_m, block.turbine_m);
    EXPECT_FALSE(block.leaves_open() || clear.leaves_open());
    if (!unknown.leaves_open()) {
      test::expect_same(block.height_m, clear.height_m);
      EXPECT_EQ(block.turbine_m, clear.turbine_m);
      continue;
    }
    for (std::size_t i = 0; i < clear.height_m.size(); ++i) {
      const float may = std::isnan(block.height_m[i]) ? clear.height_m[i] : std::nanf("");
      ASSERT_TRUE(unknown.undecided_height_m[i] == may ||
                  (std::isnan(may) && std::isnan(unknown.undecided_height_m[i])));
      open_cells += std::isnan(may) ? 0 : 1;
    }
    for (std::size_t k = 0; k < clear.turbine_m.size(); ++k) {
      EXPECT_EQ(unknown.turbine_m[k] + unknown.undecided_turbine_m[k], clear.turbine_m[k]);
      open_turbines += unknown.undecided_turbine_m[k] > 0 ? 1 : 0;
    }
  }
  EXPECT_GT(open_cells, 100U);
  EXPECT_GT(open_turbines, 0U);
  EXPECT_GT(classes, 4U);
}

/// The rows of a table of `columns` cells each.
std::vector<std::vector<std::string>> rows_of(const std::string& csv, std::size_t columns) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream table(csv);
  std::string line;
  std::getline(table, line);
  while (std::getline(table, line)) {
    std::istringstream row(line);
    std::vector<std::string> cells;
    for (std::string cell; std::getline(row, cell, ',');) cells.push_back(cell);
    EXPECT_EQ(cells.size(), columns) << line;
    rows.push_back(cells);
  }
  return rows;
}

TEST(ZoneUndecided, IsAClassOfMapsAndTables) {
  std::mt19937 random(test::seed());
  Zone zone;
  do {
    const Tin tin = holed_hills(random);
    zone = survey_under(NoData::kUnknown, tin, farms_on(tin, random));
  } while (!zone.leaves_open());
  const double cell_km2 = zone.grid.cell_area() / 1e6;
  struct Areas {
    double any = 0, more = 0, none = 0;
  };
  const auto expected = [&](const std::vector<std::uint16_t>& counts, const std::vector<std::uint16_t>& undecided) {
    Areas e;
    for (std::size_t i = 0; i < counts.size(); ++i) {
      if (counts[i] == kCountOutside) continue;
      if (undecided[i] > 0) (counts[i] == 0 ? e.any : e.more) += cell_km2;
      if (undecided[i] == 0 && counts[i] == 0) e.none += cell_km2;
    }
    return e;
  };
  const std::map<std::string, Areas> of{{"tip", expected(zone.bare.tip_count, zone.bare.tip_undecided)},
                                        {"hub", expected(zone.bare.hub_count, zone.bare.hub_undecided)}};
  std::map<std::string, Areas> rings;
  for (const auto& row : rows_of(area_table(zone), 9)) {
    Areas& sum = rings[row[1]];
    if (row[2] == "none") sum.none += std::stod(row[5]);
    if (row[2] == "undecided") {
      EXPECT_EQ(row[5], row[8]);
    }
    (row[2] == "undecided" ? sum.any : sum.more) += std::stod(row[8]);
  }
  std::map<std::string, Areas> totals;
  for (const auto& row : rows_of(area_totals(zone), 6)) {
    Areas& sum = totals[row[1]];
    if (row[2] == "none") sum.none = std::stod(row[3]);
    if (row[2] == "undecided") sum.any = std::stod(row[3]);
    if (row[2] == "any") sum.more = std::stod(row[5]);
    if (row[2] == "all") {
      EXPECT_NEAR(std::stod(row[5]), sum.any + sum.more, 0.002);
    }
  }
  for (const auto& [part, e] : of) {
    EXPECT_NEAR(rings[part].any, e.any, 1e-4) << part;
    EXPECT_NEAR(rings[part].more, e.more, 1e-4) << part;
    EXPECT_NEAR(rings[part].none, e.none, 1e-4) << part;
    EXPECT_NEAR(totals[part].any, e.any, 0.002) << part;
    EXPECT_NEAR(totals[part].more, e.more, 0.002) << part;
    EXPECT_NEAR(totals[part].none, e.none, 0.002) << part;
  }
  // Farms are seen where a tip is, and undecided where that is.
  EXPECT_NEAR(totals["farms"].any, of.at("tip").any, 0.002);
  double none = 0, open = 0;
  for (const auto& row : rows_of(combination_table(zone), 4)) {
    if (row[0] == "0") none = std::stod(row[2]);
    open += std::stod(row[3]);
  }
  EXPECT_NEAR(none, of.at("tip").none + of.at("tip").any, 1e-4);
  EXPECT_NEAR(open, of.at("tip").any + of.at("tip").more, 1e-4);
  EXPECT_GT(of.at("tip").any, 0);
  // On maps such cells are none of those from which nothing is seen.
  for (const ZoneMap& map : zone_maps(zone)) {
    ASSERT_TRUE(map.classes.back().undecided) << map.name;
    std::vector<std::uint64_t> cells(map.classes.size());
    for (const std::uint8_t c : map.class_of_cell)
      if (c != kNoMapClass) ++cells[c];
    for (std::size_t c = 0; c < cells.size(); ++c) EXPECT_EQ(cells[c], map.classes[c].cells) << map.name << " " << c;
    EXPECT_EQ(map.classes.front().open_cells, 0U);
    EXPECT_EQ(map.classes.back().open_cells, map.classes.back().cells);
  }
}

}  // namespace
}  // namespace itin::viewshed
