// Sites among houses and garden walls: what bins of the surface tell, against the walk over every triangle; the choice
// made on that, against brute force; and places on roofs.
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <itin/grazing.hpp>
#include <itin/import.hpp>
#include <itin/triangulate.hpp>
#include <viewshed/site_coverage.hpp>
#include <viewshed/site_proposal.hpp>
#include <viewshed/surface.hpp>

#include "bounds/surface_bins.hpp"
#include "judge/bin_walk.hpp"
#include "line/rounded_outwards.hpp"
#include "support/brute_force_viewshed.hpp"
#include "support/exact_line_of_sight.hpp"
#include "support/houses.hpp"
#include "support/raster_file.hpp"
#include "support/seed.hpp"
#include "support/temporary_directory.hpp"
#include "support/terrain_tin.hpp"
#include "support/told_progress.hpp"
#include "support/vector_file.hpp"
#include "viewshed/siting/proven_choice.hpp"
#include "viewshed/siting/survey_points.hpp"

namespace itin::viewshed {
namespace {

constexpr Point2 kHousesCorner{300000, 200000};
constexpr double kTownPosts = 10, kTownWidth = 390;
/// Holds what is known of the sites, but not the surface.
constexpr std::uint64_t kMemoryOfSites = 1000000;

class SitesAmongHouses : public testing::Test {
 protected:
  void SetUp() override {
    random_.seed(test::seed());
    const std::vector<double> z = test::fractal_heights(65, 15, 0.5, test::seed());
    test::write_raster(file("t.tif"), {kHousesCorner.x, kHousesCorner.y, kTownPosts, 40, 40, 27700}, [&](int c, int r) {
      if (std::hypot(c - 33, r - 7) < 2.5) return std::nan("");
      return z[static_cast<std::size_t>(r) * 65 + static_cast<std::size_t>(c)];
    });
    ImportOptions terrain;
    terrain.sources = {file("t.tif")};
    import_terrain(file("s.itin"), terrain, progress_);
    std::vector<test::LineFeature> houses, walls;
    for (int i = 0; i < 45; ++i) houses.push_back(box(uniform(7, 22), uniform(7, 22), uniform(4, 14)));
    for (int i = 0; i < 5; ++i) houses.push_back(box(6, 6, 2));  // sheds
    for (int i = 0; i < 25; ++i) walls.push_back(box(uniform(15, 50), 0.3, uniform(1.8, 2.5)));
    add(houses, ThemeKind::Buildings, "houses");
    add(walls, ThemeKind::Walls, "walls");
    store_.emplace(file("s.itin"));
    surface_ = triangulate(*store_, Window::all(), Detail::tolerance(0), progress_, ThemeChoice::all());
    ground_ = triangulate(*store_, Window::all(), Detail::tolerance(0), progress_);
  }

  std::string file(const std::string& name) const { return directory_.file(name); }
  double uniform(double least, double most) { return std::uniform_real_distribution<double>(least, most)(random_); }
  Point2 anywhere() {
    return {kHousesCorner.x + uniform(20, kTownWidth - 20), kHousesCorner.y - uniform(20, kTownWidth - 20)};
  }

  /// Turned anyhow.
  test::LineFeature box(double width, double depth, double height) {
    const Point2 p{kHousesCorner.x + uniform(40, kTownWidth - 40), kHousesCorner.y - uniform(40, kTownWidth - 40)};
    return test::turned_box(p, width, depth, uniform(0, 6), height);
  }

  void add(const std::vector<test::LineFeature>& features, ThemeKind kind, const std::string& name) {
    test::import_raised(file("s.itin"), file(name + ".geojson"), kind, name, features);
  }

  SiteSurvey survey_of(std::size_t count, bool on_roofs, bool targets_on_surface) {
    SiteSurvey survey;
    survey.themes = ThemeChoice::all();
    survey.nodata = NoData::kClear;  // as test::brute_force()
    std::vector<Point2> positions;
    for (std::size_t i = 0; i < 2 * count; ++i) positions.push_back(anywhere());
    const auto ground =
        ground_under(*store_, positions, on_roofs ? ThemeChoice::all() : ThemeChoice::none(), progress_);
    for (std::size_t i = 0; i < positions.size() && survey.positions.size() < count; ++i)
      if (ground[i])
        survey.positions.push_back({std::to_string(i), positions[i], std::round(uniform(2, 8)), *ground[i]});
    survey.radius = 130;
    survey.targets.height = 1.5;
    survey.targets.on_surface = targets_on_surface;
    survey.targets.grid = grid_of_reach(*store_, survey.positions, survey.radius, 8);
    survey.memory_bytes = kMemoryOfSites;
    return survey;
  }

  std::vector<DemandSet> truth_of(const SiteSurvey& survey, bool on_roofs) const {
    std::vector<DemandSet> truth;
    for (const SitePosition& place : survey.positions) {
      Request request = test::look(place.position, place.height, survey.targets.height, 8);
      request.radius = survey.radius;
      request.observers_on_surface = on_roofs;
      request.targets_on_surface = survey.targets.on_surface;
      const RasterGrid& grid = *survey.targets.grid;
      truth.push_back(test::seen_in(grid, test::brute_force(surface_, ground_, request, grid)));
    }
    return truth;
  }

  test::TemporaryDirectory directory_;
  std::mt19937 random_;
  std::optional<Store> store_;
  Tin surface_, ground_;
  NoProgress progress_;
};

/// At once, and in pieces of which each has a surface of its own.
TEST_F(SitesAmongHouses, BinsHoldTheSurface) {
  const test::ExactLineOfSight exact(surface_, Earth{});
  for (const bool in_pieces : {false, true}) {
    const Box all = surface_.bounds();
    SurfaceBins bins(surface_.grid, all, in_pieces ? 1.5 : 4, 100000);
    const RasterGrid tiles = bins.tiles();
    if (in_pieces) {
      for (const CellRectangle& piece :
           {CellRectangle{0, 0, 2, tiles.rows()}, CellRectangle{2, 0, tiles.columns() - 2, tiles.rows()}}) {
        const Box box = tiles.part({piece.column, piece.row}, piece.columns, piece.rows).bounds();
        const Window window = Window::box({box.xmin - 1, box.ymin - 1, box.xmax + 1, box.ymax + 1});
        bins.add(triangulate(*store_, window, Detail::tolerance(0), progress_, ThemeChoice::all()), piece);
      }
    } else {
      bins.add(surface_, all_cells(tiles));
    }
    std::size_t bare = 0, covered = 0, divided = 0;
    for (int i = 0; i < 1000; ++i) {
      const Point2 p{uniform(all.xmin - 1, all.xmax + 1), uniform(all.ymin - 1, all.ymax + 1)};
      const Point2 units{(p.x - bins.units().origin.x) / bins.units().resolution,
                         (p.y - bins.units().origin.y) / bins.units().resolution};
      const double column = bins.column_at(units.x), row = bins.row_at(units.y);
      const RasterGrid::Cell bin{static_cast<std::int64_t>(std::floor(column)),
                                 static_cast<std::int64_t>(std::floor(row))};
      if (bin.column < 0 || bin.row < 0 || bin.column >= bins.columns() || bin.row >= bins.rows()) continue;
      const auto height = exact.height(p);
      const double z = height.value_or(0) / bins.units().resolution;
      const auto holds = [&](const SurfaceBins::Range& range) {
        if (!height) return range.low == -kFloatInfinity;
        covered += range.low > -kFloatInfinity;
        return range.low < z && range.high > z;
      };
      bare += !height;
      ASSERT_TRUE(holds(bins.range(bin))) << p.x << ' ' << p.y;
      const SurfaceBins::Parts* const parts = bins.parts(bin);
      if (parts == nullptr) continue;
      const auto part = [](double v) { return static_cast<std::size_t>((v - std::floor(v)) * SurfaceBins::kParts); };
      ASSERT_TRUE(holds((*parts)[part(row) * SurfaceBins::kParts + part(column)])) << p.x << ' ' << p.y;
      ++divided;
    }
    EXPECT_GT(bare, 1U);
    EXPECT_GT(covered, 700U);
    EXPECT_GT(divided, 5U);
  }
}

TEST_F(SitesAmongHouses, WhatBinsDecideIsRight) {
  const Earth earth;
  const test::ExactLineOfSight exact(surface_, earth);
  SurfaceBins bins(surface_.grid, surface_.bounds(), 0.5, 100000);
  bins.add(surface_, all_cells(bins.tiles()));
  const double resolution = surface_.grid.resolution;
  const BinWalk walk(bins, earth.drop_coefficient() * resolution);
  std::array<int, 3> count{};
  for (int i = 0; i < 800; ++i) {
    const Point2 a = anywhere(), b = anywhere();
    const auto za = exact.height(a), zb = exact.height(b);
    if (!za || !zb) continue;
    const Point3 from{a.x, a.y, *za + uniform(0, 12)}, to{b.x, b.y, *zb + (i % 3 == 0 ? 0 : uniform(0, 6))};
    const auto units = [&](const Point3& p) {
      return Point3{(p.x - surface_.grid.origin.x) / resolution, (p.y - surface_.grid.origin.y) / resolution,
                    p.z / resolution};
    };
    const Verdict verdict = walk.along(units(from), units(to));
    const double clearance = exact.clearance(from, to);
    ASSERT_TRUE(verdict != Verdict::kHidden || clearance < -kGrazing) << clearance;
    ASSERT_TRUE(verdict != Verdict::kVisible || clearance > 0) << clearance;
    ++count[verdict == Verdict::kHidden ? 0 : verdict == Verdict::kVisible ? 1 : 2];
  }
  EXPECT_GT(count[0] + count[1], 3 * count[2]) << count[0] << ' ' << count[1] << ' ' << count[2];
  EXPECT_GT(count[1], 20);
}

TEST_F(SitesAmongHouses, TheChoiceByBoundsIsThatOfBruteForce) {
  for (const bool on_surface : {false, true}) {
    SiteSurvey survey = survey_of(12, on_surface, on_surface);
    const std::vector<DemandSet> truth = truth_of(survey, on_surface);
    const std::size_t again = test::expect_choice(*store_, survey, truth, 3);
    EXPECT_LT(again, truth.size());
    survey.engine = Engine::kRays;
    EXPECT_EQ(test::expect_choice(*store_, survey, truth, 3), again);
  }
}

TEST_F(SitesAmongHouses, PointsAreBoundedAsCellsAre) {
  const SiteSurvey survey = survey_of(6, false, false);
  const std::vector<DemandSet> truth = truth_of(survey, false);
  SiteCoverage coverage(*store_, test::survey_of_points(survey), progress_);
  coverage.explore();
  ASSERT_EQ(coverage.last_stage(), 1);
  for (;;) {
    std::size_t possible = 0, served = 0;
    for (std::size_t i = 0; i < truth.size(); ++i) {
      CoverageBounds bounds = coverage.bounds(i);
      for (DemandSet* const set : {&bounds.certain, &bounds.possible})
        *set = test::without_padding(*survey.targets.grid, *set);
      test::expect_bounds_hold(bounds, truth[i]);
      possible += bounds.possible.size(), served += truth[i].size();
    }
    EXPECT_LT(possible, 3 * served);
    if (coverage.bounds(0).exact) break;
    std::vector<std::size_t> all{0, 1, 2, 3, 4, 5};
    coverage.refine(all);
  }
}

/// Missing ground may hide what bins have in sight, and a zone be cut; both hide nothing else.
TEST_F(SitesAmongHouses, MissingGroundAndZonesLeaveBoundsRight) {
  SiteSurvey survey = survey_of(6, false, false);
  const auto expect_bounds_of_the_last_look = [&] {
    SiteCoverage coverage(*store_, survey, progress_);
    coverage.explore();
    ASSERT_EQ(coverage.last_stage(), 1);
    for (std::size_t i = 0; i < survey.positions.size(); ++i) {
      const CoverageBounds first = coverage.bounds(i);
      coverage.refine({&i, 1});
      EXPECT_TRUE(coverage.bounds(i).exact);
      test::expect_bounds_hold(first, coverage.bounds(i).certain);
    }
  };
  survey.nodata = NoData::kBlock;
  expect_bounds_of_the_last_look();
  survey.nodata = NoData::kClear;
  survey.fresnel = FresnelCriterion{.wavelength = 0.06, .fraction = 0.6};
  expect_bounds_of_the_last_look();
}

TEST_F(SitesAmongHouses, BoundsDoNotDependOnTheThreads) {
  const SiteSurvey survey = survey_of(6, false, false);
  test::ToldProgress told;
  SiteCoverage many(*store_, survey, told), one(*store_, survey, progress_);
  const auto before = static_cast<std::ptrdiff_t>(told.all().size());
  many.explore();
  EXPECT_TRUE(std::is_sorted(told.all().begin() + before, told.all().end()));
  EXPECT_EQ(told.all().back(), 1);
  {
    const ThreadLimit limit(1);
    one.explore();
  }
  for (std::size_t i = 0; i < survey.positions.size(); ++i) {
    EXPECT_TRUE(many.bounds(i).certain == one.bounds(i).certain);
    EXPECT_TRUE(many.bounds(i).possible == one.bounds(i).possible);
  }
}

TEST_F(SitesAmongHouses, ASurfaceInMemoryIsJudgedExactlyAtOnce) {
  SiteSurvey survey = survey_of(6, true, true);
  survey.memory_bytes = std::uint64_t{1} << 30;
  const std::vector<DemandSet> truth = truth_of(survey, true);
  SiteCoverage coverage(*store_, survey, progress_);
  coverage.explore();
  EXPECT_EQ(coverage.last_stage(), 0);
  EXPECT_EQ(coverage.stage_name(0), "exact, with themes");
  for (std::size_t i = 0; i < truth.size(); ++i) {
    EXPECT_TRUE(coverage.bounds(i).exact);
    test::expect_bounds_hold(coverage.bounds(i), truth[i]);
  }
}

TEST_F(SitesAmongHouses, RoofsAreProposedWhereTheyAreHighEnough) {
  const Window area = Window::box({kHousesCorner.x + 20, kHousesCorner.y - kTownWidth + 20,
                                   kHousesCorner.x + kTownWidth - 20, kHousesCorner.y - 20});
  ProposalRequest request{.spacing = 60, .radius = 130, .mast_height = 3, .target_height = 1.5, .earth = {}};
  request.themes = ThemeChoice::all();
  for (const bool on_surface : {false, true}) {
    request.on_surface = on_surface;
    const std::vector<Proposal> proposals = propose_sites(*store_, area, request, progress_);
    std::vector<Point2> places;
    for (const Proposal& p : proposals) places.push_back(p.position);
    const auto bare = ground_under(*store_, places, ThemeChoice::none(), progress_),
               above = ground_under(*store_, places, ThemeChoice::all(), progress_);
    std::size_t roofs = 0;
    for (std::size_t i = 0; i < proposals.size(); ++i) {
      roofs += proposals[i].roof;
      const double rise = *above[i] - *bare[i];
      EXPECT_TRUE(!proposals[i].roof || rise > 2.99) << rise;
      EXPECT_TRUE(proposals[i].roof || std::abs(rise) < 0.06) << rise;
    }
    EXPECT_TRUE(on_surface ? roofs > 10 : roofs == 0) << roofs;
  }
}

/// Lidar, the buildings of 3dfier and garden walls; half of the town.
TEST(DelftSiting, TheChoiceByBoundsIsThatOfBruteForce) {
  const std::string data = ITIN_DATA_DIR, delft = data + "/ahn3-bgt-delft/";
  const std::string lidar = data + "/derived-las/ahn3_cropped_2.las";
  if (!std::filesystem::exists(lidar) || !std::filesystem::exists(delft)) GTEST_SKIP() << "needs " << lidar;
  const test::TemporaryDirectory directory;
  NoProgress progress;
  const std::string path = directory.file("delft.itin");
  ImportOptions terrain;
  terrain.sources = {lidar};
  terrain.classes = {2, 9};
  terrain.crs = "EPSG:28992";
  import_terrain(path, terrain, progress);
  ImportOptions buildings;
  buildings.sources = {delft + "output/testarea.json"};
  buildings.kind = ThemeKind::Buildings;
  buildings.theme = "buildings";
  buildings.crs = "EPSG:28992";
  import_lines(path, buildings, progress);
  const Store store(path);
  const Box extent = extent_of(store);
  SiteSurvey survey;
  survey.themes = ThemeChoice::all();
  std::mt19937 random(test::seed());
  std::uniform_real_distribution<double> east(extent.xmin, extent.xmax), north(extent.ymin, extent.ymax);
  std::vector<Point2> positions;
  for (int i = 0; i < 60; ++i) positions.push_back({east(random), north(random)});
  const auto ground = ground_under(store, positions, ThemeChoice::none(), progress);
  for (std::size_t i = 0; i < positions.size() && survey.positions.size() < 20; ++i)
    if (ground[i]) survey.positions.push_back({std::to_string(i), positions[i], 4, *ground[i]});
  survey.radius = 60;
  survey.targets.height = 1.5;
  survey.targets.grid = grid_of_reach(store, survey.positions, survey.radius, 4);
  survey.memory_bytes = 20000000;
  const std::vector<DemandSet> truth = test::exact_coverage(store, survey);
  EXPECT_LE(test::expect_choice(store, survey, truth, 4), truth.size() / 2);
}

}  // namespace
}  // namespace itin::viewshed
