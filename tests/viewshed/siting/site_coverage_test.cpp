// Bounds of what sites serve, against precise viewsheds; and the choice made on them, against brute force.
#include <algorithm>
#include <iostream>
#include <numeric>
#include <random>
#include <type_traits>

#include <gtest/gtest.h>

#include <itin/import.hpp>
#include <viewshed/result.hpp>
#include <viewshed/site_coverage.hpp>
#include <viewshed/site_proposal.hpp>

#include "support/alexandria.hpp"
#include "support/full_detail.hpp"
#include "support/raster_file.hpp"
#include "support/seed.hpp"
#include "support/slow_greedy.hpp"
#include "support/subset.hpp"
#include "support/temporary_directory.hpp"
#include "support/terrain_tin.hpp"
#include "support/told_progress.hpp"
#include "viewshed/siting/survey_points.hpp"

namespace itin::viewshed {
namespace {

constexpr Point2 kSitesCorner{300000, 200000};
constexpr double kSitesStep = 50, kRadius = 1500;
/// By 700 m of its middle.
constexpr Point2 kWestOfTheHole{kSitesCorner.x + 35 * kSitesStep - 700, kSitesCorner.y - 60 * kSitesStep};

class Sites : public ::testing::Test {
 protected:
  void make_terrain(int side, double relief, bool with_void) {
    random_.seed(test::seed());
    const std::vector<double> z = test::fractal_heights(129, relief, 0.55, test::seed());
    const std::string raster = directory_.file("t.tif"), path = directory_.file("t.itin");
    test::write_raster(raster, {kSitesCorner.x, kSitesCorner.y, kSitesStep, side, side, 27700}, [&](int c, int r) {
      if (with_void && std::hypot(c - 0.35 * side, r - 0.6 * side) < 6) return std::nan("");
      return z[static_cast<std::size_t>(r) * 129 + static_cast<std::size_t>(c)];
    });
    ImportOptions options;
    options.sources = {raster};
    import_terrain(path, options, progress_);
    store_.emplace(path);
    side_ = side;
  }

  void make_survey(std::size_t count) {
    std::uniform_real_distribution<double> anywhere(0, side_ * kSitesStep), height(2, 40);
    std::vector<Point2> positions;
    for (std::size_t i = 0; i < 2 * count; ++i)
      positions.push_back({kSitesCorner.x + anywhere(random_), kSitesCorner.y - anywhere(random_)});
    const auto ground = ground_under(*store_, positions, ThemeChoice::none(), progress_);
    for (std::size_t i = 0; i < positions.size() && survey_.positions.size() < count; ++i)
      if (ground[i])
        survey_.positions.push_back({std::to_string(i), positions[i], std::round(height(random_)), *ground[i]});
    survey_.radius = kRadius;
    survey_.targets.height = 2;
    survey_.targets.grid = grid_of_reach(*store_, survey_.positions, kRadius, 60);
    survey_.tolerance = 4;
  }

  SitePosition mast(Point2 position, double height) {
    return {"mast", position, height, ground_under(*store_, {position}, ThemeChoice::none(), progress_)[0].value()};
  }

  /// The cells that test::compute_at_full_detail() says are certainly in sight of one site.
  DemandSet precise(std::size_t option) { return precise(option, survey_.nodata, {Verdict::kVisible}); }

  /// Those of one of the verdicts under a rule.
  DemandSet precise(std::size_t option, NoData rule, const std::vector<Verdict>& verdicts) {
    const SitePosition& place = survey_.positions[option];
    Request request;
    request.observers = {{place.name, place.position, place.height}};
    request.target_height = survey_.targets.height;
    request.radius = survey_.radius;
    request.grid = survey_.targets.grid;
    request.nodata = rule;
    const Result result = test::compute_at_full_detail(*store_, request, {}, progress_).result;
    DemandSet set;
    const RasterGrid& grid = *survey_.targets.grid;
    for (std::size_t block = 0; block < element_count(grid) / 64; ++block) {
      std::uint64_t members = 0;
      for (std::size_t bit = 0; bit < 64; ++bit) {
        const RasterGrid::Cell cell = cell_of(grid, 64 * block + bit);
        if (cell.column < grid.columns() && cell.row < grid.rows() &&
            std::find(verdicts.begin(), verdicts.end(), result.visible[grid.index(cell)]) != verdicts.end())
          members |= std::uint64_t{1} << bit;
      }
      set.add(static_cast<std::uint32_t>(block), members);
    }
    return set;
  }

  std::vector<DemandSet> all_precise() {
    std::vector<DemandSet> sets;
    for (std::size_t i = 0; i < survey_.positions.size(); ++i) sets.push_back(precise(i));
    return sets;
  }

  static void expect_bounds(const CoverageBounds& bounds, const DemandSet& truth) {
    EXPECT_TRUE(test::is_subset(bounds.certain, truth));
    EXPECT_TRUE(test::is_subset(truth, bounds.possible));
    if (bounds.exact) {
      EXPECT_TRUE(bounds.certain == truth);
      EXPECT_TRUE(bounds.possible == truth);
    }
  }

  void expect_bounds_at_every_stage(SiteCoverage& coverage, const std::vector<DemandSet>& truth) {
    std::vector<std::size_t> all;
    for (std::size_t i = 0; i < truth.size(); ++i) all.push_back(i);
    coverage.explore();
    for (int stage = 0;; ++stage) {
      for (const std::size_t i : all) {
        EXPECT_EQ(coverage.stage(i), stage);
        expect_bounds(coverage.bounds(i), truth[i]);
      }
      if (stage == coverage.last_stage()) break;
      coverage.refine(all);
    }
    for (const std::size_t i : all) EXPECT_TRUE(coverage.bounds(i).exact);
  }

  test::TemporaryDirectory directory_;
  std::optional<Store> store_;
  int side_ = 0;
  SiteSurvey survey_;
  std::mt19937 random_;
  NoProgress progress_;
};

TEST_F(Sites, BoundsHoldAndTheLastLookIsPrecise) {
  make_terrain(100, 200, true);
  make_survey(8);
  const std::vector<DemandSet> truth = all_precise();
  SiteCoverage coverage(*store_, survey_, progress_);
  expect_bounds_at_every_stage(coverage, truth);
  EXPECT_FALSE(truth[0].empty());
}

TEST_F(Sites, TheMemoryChangesNothingExact) {
  make_terrain(100, 200, false);
  make_survey(8);
  survey_.memory_bytes = 110000;
  SiteCoverage coverage(*store_, survey_, progress_);
  expect_bounds_at_every_stage(coverage, all_precise());
}

/// The coverage known of every site is counted block by block, before and after every stage.
TEST_F(Sites, WhatIsKnownOfThemTakesNoMoreThanIsCountedOn) {
  make_terrain(100, 200, false);
  make_survey(8);
  const auto counted = [&](const SiteCoverage& coverage) {
    std::uint64_t blocks = 0;
    for (std::size_t i = 0; i < survey_.positions.size(); ++i)
      for (const CoverageBounds* bounds : {&coverage.bounds(i), &coverage.first_bounds(i)})
        for (const DemandSet* set : {&bounds->certain, &bounds->possible}) blocks += set->blocks().capacity();
    return sizeof(DemandSet::Block) * blocks;
  };
  std::uint64_t most = 0;
  SiteCoverage coverage(*store_, survey_, progress_);
  most = std::max(most, counted(coverage));
  coverage.explore();
  most = std::max(most, counted(coverage));
  coverage.release_surfaces();
  std::vector<std::size_t> all(survey_.positions.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  while (coverage.stage(0) < coverage.last_stage()) {
    coverage.refine(all);
    most = std::max(most, counted(coverage));
  }
  EXPECT_LE(most, bytes_of_coverage(survey_));
  EXPECT_GT(8 * most, bytes_of_coverage(survey_));
}

TEST_F(Sites, TooLittleMemoryForWhatIsKnownOfThemIsRefused) {
  make_terrain(100, 200, false);
  make_survey(8);
  survey_.memory_bytes = bytes_of_coverage(survey_);
  try {
    const SiteCoverage coverage(*store_, survey_, progress_);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("`memory_bytes`"), std::string::npos) << error.what();
  }
}

TEST_F(Sites, WhatIsMissingHidesIfThatIsAskedFor) {
  make_terrain(100, 200, true);
  make_survey(8);
  survey_.nodata = NoData::kBlock;
  const std::vector<DemandSet> truth = all_precise();
  SiteCoverage coverage(*store_, survey_, progress_);
  expect_bounds_at_every_stage(coverage, truth);
  survey_.tolerance.reset();
  SiteCoverage at_once(*store_, survey_, progress_);
  EXPECT_EQ(at_once.last_stage(), 0);
  expect_bounds_at_every_stage(at_once, truth);
}

/// Served is what single viewsheds certainly see; what they leave undecided is served under kClear besides.
TEST_F(Sites, WhatIsMissingLeavesOpenWhatViewshedsLeaveUndecided) {
  make_terrain(100, 200, true);
  make_survey(7);
  survey_.positions.push_back(mast(kWestOfTheHole, 300));
  survey_.targets.grid = grid_of_reach(*store_, survey_.positions, kRadius, 60);
  const auto exact = [&](std::size_t site, const SiteSurvey& survey, NoData rule) {
    SiteSurvey under = survey;
    under.nodata = rule;
    SiteCoverage coverage(*store_, under, progress_);
    EXPECT_EQ(coverage.leaves_open(), rule == NoData::kUnknown);
    while (!coverage.bounds(site).exact) coverage.refine({&site, 1});
    return test::without_padding(*survey_.targets.grid, coverage.bounds(site).certain);
  };
  std::size_t undecided = 0;
  for (std::size_t site = 0; site < survey_.positions.size(); ++site) {
    const DemandSet seen = precise(site, NoData::kUnknown, {Verdict::kVisible}),
                    open = precise(site, NoData::kUnknown, {Verdict::kUndecided});
    undecided += open.size();
    for (const SiteSurvey& survey : {survey_, test::survey_of_points(survey_)}) {
      const DemandSet certain = exact(site, survey, NoData::kUnknown), possible = exact(site, survey, NoData::kClear);
      EXPECT_EQ(certain, seen);
      EXPECT_EQ(certain, exact(site, survey, NoData::kBlock));
      EXPECT_EQ(possible, set_union(certain, open));
      EXPECT_EQ(difference(possible, certain), open);
    }
  }
  EXPECT_GT(undecided, 0U);
}

/// The worst case for a site that is to be hidden: what is undecided counts as seen, at every stage.
TEST_F(Sites, OpenTargetsCountAsServedWhereTheSurveyAsksForTheWorstCase) {
  make_terrain(100, 200, true);
  make_survey(7);
  survey_.positions.push_back(mast(kWestOfTheHole, 300));
  survey_.targets.grid = grid_of_reach(*store_, survey_.positions, kRadius, 60);
  survey_.open = OpenTargets::kServed;
  std::vector<DemandSet> truth;
  std::size_t undecided = 0;
  for (std::size_t site = 0; site < survey_.positions.size(); ++site) {
    truth.push_back(precise(site, NoData::kUnknown, {Verdict::kVisible, Verdict::kUndecided}));
    undecided += precise(site, NoData::kUnknown, {Verdict::kUndecided}).size();
  }
  ASSERT_GT(undecided, 0U);
  SiteCoverage coverage(*store_, survey_, progress_);
  EXPECT_TRUE(coverage.leaves_open());
  expect_bounds_at_every_stage(coverage, truth);
  survey_.nodata = NoData::kBlock;
  SiteCoverage blocked(*store_, survey_, progress_);
  std::vector<DemandSet> seen;
  for (std::size_t site = 0; site < survey_.positions.size(); ++site)
    seen.push_back(precise(site, NoData::kUnknown, {Verdict::kVisible}));
  expect_bounds_at_every_stage(blocked, seen);
}

TEST_F(Sites, NothingIsLeftOpenWhereNoLineCrossesMissingGround) {
  make_terrain(100, 200, true);
  make_survey(8);
  survey_.positions = {mast({kSitesCorner.x + 4500, kSitesCorner.y - 500}, 30)};
  SiteCoverage coverage(*store_, survey_, progress_);
  EXPECT_FALSE(coverage.leaves_open());
  expect_bounds_at_every_stage(coverage, all_precise());
}

/// From where the hole's rim begins to hide its own ground, 632 m away.
TEST_F(Sites, MissingGroundCountsAsFarAsTheRadius) {
  make_terrain(100, 200, true);
  survey_.positions = {mast(kWestOfTheHole, 300)};
  survey_.targets.height = 2;
  for (const double radius : {550.0, 1200.0}) {
    survey_.radius = radius;
    survey_.targets.grid = grid_of_reach(*store_, survey_.positions, radius, 20);
    const bool reaches = radius > 632;
    EXPECT_EQ(precise(0, NoData::kUnknown, {Verdict::kUndecided}).empty(), !reaches);
    SiteCoverage coverage(*store_, survey_, progress_);
    EXPECT_EQ(coverage.leaves_open(), reaches);
    expect_bounds_at_every_stage(coverage, all_precise());
  }
}

TEST_F(Sites, PointsAreServedAsCellsAtTheSamePlaces) {
  make_terrain(80, 200, true);
  make_survey(5);
  const std::vector<DemandSet> truth = all_precise();
  SiteCoverage coverage(*store_, test::survey_of_points(survey_), progress_);
  std::vector<std::size_t> all{0, 1, 2, 3, 4};
  coverage.explore();
  const auto inside = [&](const DemandSet& set) { return test::without_padding(*survey_.targets.grid, set); };
  for (;;) {
    for (const std::size_t i : all) {
      CoverageBounds bounds = coverage.bounds(i);
      bounds = {inside(bounds.certain), inside(bounds.possible), bounds.exact};
      expect_bounds(bounds, truth[i]);
    }
    if (coverage.bounds(0).exact) break;
    coverage.refine(all);
  }
}

TEST_F(Sites, TheChoiceIsThatOfBruteForce) {
  make_terrain(129, 250, false);
  make_survey(40);
  survey_.tolerance = 2;
  const std::vector<DemandSet> truth = all_precise();
  const Demand demand(element_count(*survey_.targets.grid));
  std::vector<SiteOption> options;
  for (std::size_t i = 0; i < truth.size(); ++i) options.push_back({i, 1});

  const std::vector<std::size_t> slow = test::greedy_by_brute_force(truth, demand, 6);

  SiteCoverage coverage(*store_, survey_, progress_);
  coverage.explore();
  ChoiceGoal goal{.count = 6};
  goal.swaps = false;
  goal.batch = 2;
  const Choice choice = choose(demand, options, coverage, goal, progress_);
  std::vector<std::size_t> chosen;
  for (const ChosenSite& site : choice.chosen) chosen.push_back(site.option);
  EXPECT_EQ(chosen, slow);
  EXPECT_EQ(choice.value, test::value_of(slow, truth, demand));
  std::size_t refined = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) refined += coverage.stage(i) > 0;
  EXPECT_LT(refined, truth.size());
}

TEST_F(Sites, NothingIsSaidToBeDoneWhereAllIsPutBack) {
  make_terrain(80, 200, false);
  make_survey(3);
  SiteCoverage coverage(*store_, survey_, progress_);
  coverage.explore();
  test::ToldProgress told;
  SiteCoverage other(*store_, survey_, told);
  for (std::size_t i = 0; i < 3; ++i) other.restore(i, coverage.stage(i), coverage.bounds(i));
  const std::size_t before = told.all().size();
  other.explore();
  EXPECT_EQ(told.all().size(), before);
}

TEST_F(Sites, WhatWasFoundCanBePutBack) {
  make_terrain(80, 200, false);
  make_survey(6);
  SiteCoverage coverage(*store_, survey_, progress_);
  coverage.explore();
  SiteCoverage other(*store_, survey_, progress_);
  std::size_t told = 0;
  other.on_refined = [&](std::size_t, int, const CoverageBounds&) { ++told; };
  for (std::size_t i = 0; i < 3; ++i) other.restore(i, coverage.stage(i), coverage.bounds(i));
  other.explore();
  EXPECT_GE(told, 3U);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(other.stage(i), 0);
    EXPECT_TRUE(other.bounds(i).possible == coverage.bounds(i).possible);
    EXPECT_TRUE(other.bounds(i).certain == coverage.bounds(i).certain);
    EXPECT_TRUE(other.first_bounds(i).possible == coverage.first_bounds(i).possible);
  }
  told = 0;
  other.explore();
  EXPECT_EQ(told, 0U);
}

TEST_F(Sites, SitesAreProposedOnSummitsAndSpaced) {
  make_terrain(129, 250, false);
  const Window area =
      Window::box({kSitesCorner.x + 1000, kSitesCorner.y - 5000, kSitesCorner.x + 5000, kSitesCorner.y - 1000});
  const ProposalRequest request{.spacing = 1000, .radius = 2000, .mast_height = 20, .target_height = 2, .earth = {}};
  const std::vector<Proposal> proposals = propose_sites(*store_, area, request, progress_);
  EXPECT_GE(proposals.size(), 16U);
  EXPECT_LE(proposals.size(), 50U);
  double chosen = 0;
  for (const Proposal& p : proposals) {
    EXPECT_TRUE(area.contains(p.position));
    chosen += p.visibility_index;
  }
  // They see more than places at random.
  survey_.positions.clear();
  make_survey(30);
  EXPECT_TRUE(std::any_of(proposals.begin(), proposals.end(), [](const Proposal& p) { return p.summit; }));
  EXPECT_EQ(propose_sites(*store_, area, request, progress_).size(), proposals.size());
  EXPECT_GT(chosen / static_cast<double>(proposals.size()), 0);
}

TEST(SitesInTown, FeaturesOnlyHide) {
  const test::TemporaryDirectory directory;
  NoProgress progress;
  const std::string path = directory.file("town.itin");
  test::import_alexandria(path);
  const Store store(path);
  SiteSurvey survey;
  const std::vector<Point2> positions{{321800, 4297750}, {321700, 4297700}};
  const auto ground = ground_under(store, positions, ThemeChoice::none(), progress);
  for (std::size_t i = 0; i < positions.size(); ++i) survey.positions.push_back({"s", positions[i], 10, *ground[i]});
  survey.radius = 200;
  survey.targets.height = 1.5;
  survey.targets.grid = grid_of_reach(store, survey.positions, survey.radius, 4);
  SiteCoverage bare(store, survey, progress);
  survey.themes = ThemeChoice::all();
  SiteCoverage themed(store, survey, progress);
  for (std::size_t i = 0; i < positions.size(); ++i) {
    while (!bare.bounds(i).exact) bare.refine({&i, 1});
    DemandSet before = themed.bounds(i).possible;
    while (!themed.bounds(i).exact) {
      themed.refine({&i, 1});
      EXPECT_TRUE(test::is_subset(themed.bounds(i).possible, before));
      before = themed.bounds(i).possible;
    }
    EXPECT_TRUE(test::is_subset(themed.bounds(i).certain, bare.bounds(i).certain));
    EXPECT_LT(themed.bounds(i).certain.size(), bare.bounds(i).certain.size());
    EXPECT_GT(themed.bounds(i).certain.size(), 0U);
    Request request;
    request.observers = {{"s", positions[i], 10}};
    request.target_height = 1.5;
    request.radius = survey.radius;
    request.grid = survey.targets.grid;
    request.themes = ThemeChoice::all();
    const Result precise = test::compute_at_full_detail(store, request, {}, progress).result;
    std::uint64_t different = 0;
    const RasterGrid& grid = *survey.targets.grid;
    for (std::int64_t row = 0; row < grid.rows(); ++row)
      for (std::int64_t column = 0; column < grid.columns(); ++column)
        different += (precise.visible[grid.index({column, row})] == Verdict::kVisible) !=
                     themed.bounds(i).certain.contains(element_of(grid, {column, row}));
    EXPECT_EQ(different, 0U);
  }
}

TEST(SiteCoverage, TakesNoStoreThatIsGoneTheNextMoment) {
  static_assert(std::is_constructible_v<SiteCoverage, const Store&, SiteSurvey, Progress&>);
  static_assert(!std::is_constructible_v<SiteCoverage, Store, SiteSurvey, Progress&>);
}

}  // namespace
}  // namespace itin::viewshed
