// Sites that serve what their Fresnel zones leave clear: bounds, the last look and the choice against itin los --links.
#include <atomic>
#include <cmath>
#include <iostream>
#include <random>

#include <gtest/gtest.h>

#include <itin/import.hpp>
#include <profile/links.hpp>
#include <viewshed/site_coverage.hpp>

#include "support/houses.hpp"
#include "support/raster_file.hpp"
#include "support/seed.hpp"
#include "support/slow_greedy.hpp"
#include "support/subset.hpp"
#include "support/temporary_directory.hpp"
#include "support/terrain_tin.hpp"
#include "support/vector_file.hpp"
#include "viewshed/siting/survey_points.hpp"

namespace itin::viewshed {
namespace {

constexpr Point2 kHillsCorner{300000, 200000};
constexpr double kHillsStep = 50;

class FresnelSites : public ::testing::Test {
 protected:
  double draw(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }

  template <class HeightAt>
  void make_store(int side, const HeightAt& height) {
    test::write_raster(directory_.file("t.tif"), {kHillsCorner.x, kHillsCorner.y, kHillsStep, side, side, 27700},
                       height);
    ImportOptions options;
    options.sources = {directory_.file("t.tif")};
    import_terrain(path(), options, progress_);
    side_ = side;
  }
  void make_fractal(int side, double relief, bool with_void) {
    const std::vector<double> z = test::fractal_heights(129, relief, 0.55, random_());
    make_store(side, [&](int c, int r) {
      if (with_void && std::hypot(c - 0.35 * side, r - 0.6 * side) < 6) return std::nan("");
      return z[static_cast<std::size_t>(r) * 129 + static_cast<std::size_t>(c)];
    });
  }
  void add_houses(int count) {
    std::vector<test::LineFeature> houses;
    for (int i = 0; i < count; ++i) {
      const double x = kHillsCorner.x + draw(200, side_ * kHillsStep - 200),
                   y = kHillsCorner.y - draw(200, side_ * kHillsStep - 200);
      houses.push_back(test::box(x, y, x + draw(10, 60), y + draw(10, 60), draw(4, 25)));
    }
    test::import_houses(path(), directory_.file("houses.geojson"), houses);
    survey_.themes = ThemeChoice::all();
  }

  void make_survey(std::size_t count) {
    store_.emplace(path());
    std::vector<Point2> positions;
    for (std::size_t i = 0; i < 2 * count; ++i)
      positions.push_back({kHillsCorner.x + draw(0, side_ * kHillsStep), kHillsCorner.y - draw(0, side_ * kHillsStep)});
    const auto ground = ground_under(*store_, positions, ThemeChoice::none(), progress_);
    for (std::size_t i = 0; i < positions.size() && survey_.positions.size() < count; ++i)
      if (ground[i])
        survey_.positions.push_back({std::to_string(i), positions[i], std::round(draw(2, 40)), *ground[i]});
    survey_.radius = 1200;
    survey_.targets.height = draw(0.5, 10);
    survey_.targets.grid = grid_of_reach(*store_, survey_.positions, survey_.radius, 80);
    survey_.tolerance = 2;
    // With little memory zones are judged over the coarse surface, too.
    if (draw(0, 1) < 0.5) survey_.memory_bytes = 4000000;
    survey_.earth = draw(0, 1) < 0.5 ? Earth{} : Earth::effective_earth(4.0 / 3);
    survey_.nodata = draw(0, 1) < 0.5 ? NoData::kUnknown : NoData::kBlock;
    frequency_ghz_ = std::exp(draw(std::log(0.2), std::log(10)));
    survey_.fresnel = FresnelCriterion{profile::wavelength_m(frequency_ghz_), draw(0.1, 1)};
  }

  /// The verdict of itin los on each pair.
  DemandSet served(std::size_t option, const ThemeChoice& themes) {
    const RasterGrid& grid = *survey_.targets.grid;
    const SitePosition& place = survey_.positions[option];
    std::vector<std::size_t> elements;
    std::vector<profile::Link> links;
    for (std::int64_t row = 0; row < grid.rows(); ++row) {
      for (std::int64_t column = 0; column < grid.columns(); ++column) {
        const Point2 p = grid.centre(column, row);
        const double dx = p.x - place.position.x, dy = p.y - place.position.y;
        if (dx * dx + dy * dy > survey_.radius * survey_.radius) continue;
        elements.push_back(element_of(grid, {column, row}));
        links.push_back({"", place.position, place.height, p, survey_.targets.height});
      }
    }
    profile::LinkQuery query;
    query.earth = survey_.earth;
    query.themes = themes;
    query.radio = profile::RadioPath{.frequency_ghz = frequency_ghz_, .effective_earth_km = 8500};
    query.nodata = survey_.nodata;
    query.to_on_surface = survey_.targets.on_surface;
    const std::vector<profile::LinkResult> results = survey_links(*store_, links, query, progress_);
    std::vector<std::uint64_t> members(element_count(grid) / 64);
    for (std::size_t i = 0; i < results.size(); ++i) {
      const auto& found = results[i].found;
      if (!found || found->verdict != profile::SightVerdict::kVisible) continue;
      ++in_sight_;
      if (!found->fresnel || found->fresnel->fraction >= survey_.fresnel->fraction)
        members[elements[i] / 64] |= std::uint64_t{1} << elements[i] % 64;
    }
    DemandSet set;
    for (std::size_t b = 0; b < members.size(); ++b) set.add(static_cast<std::uint32_t>(b), members[b]);
    return set;
  }
  std::vector<DemandSet> all_served() {
    std::vector<DemandSet> sets;
    const bool raised = survey_.themes.includes_raised(store_->metadata().themes);
    for (std::size_t i = 0; i < survey_.positions.size(); ++i) {
      sets.push_back(served(i, survey_.themes));
      // Sites keep to what the bare terrain allows, also where a house's edge lowers the ground beside it by a hair.
      if (raised && !survey_.targets.on_surface)
        sets.back() = intersection(sets.back(), served(i, ThemeChoice::none()));
    }
    return sets;
  }

  DemandSet inside(const DemandSet& set) const { return test::without_padding(*survey_.targets.grid, set); }

  void expect_bounds_at_every_stage(const SiteSurvey& survey, const std::vector<DemandSet>& truth) {
    SiteCoverage coverage(*store_, survey, progress_);
    std::vector<std::size_t> all;
    for (std::size_t i = 0; i < truth.size(); ++i) all.push_back(i);
    coverage.explore();
    for (int stage = 0;; ++stage) {
      for (const std::size_t i : all) {
        const CoverageBounds& bounds = coverage.bounds(i);
        const DemandSet certain = inside(bounds.certain), possible = inside(bounds.possible);
        EXPECT_TRUE(test::is_subset(certain, truth[i])) << "stage " << stage << ", site " << i;
        EXPECT_TRUE(test::is_subset(truth[i], possible)) << "stage " << stage << ", site " << i;
        EXPECT_TRUE(!bounds.exact || (certain == truth[i] && possible == truth[i])) << "site " << i;
      }
      if (stage == coverage.last_stage()) break;
      coverage.refine(all);
    }
    for (const std::size_t i : all) EXPECT_TRUE(coverage.bounds(i).exact);
  }

  /// Over cells, and over points at the same places.
  void expect_law_four() {
    const std::vector<DemandSet> truth = all_served();
    std::size_t sum = 0;
    for (const DemandSet& set : truth) sum += set.size();
    EXPECT_LT(sum, in_sight_);  // the zone matters
    expect_bounds_at_every_stage(survey_, truth);
    const SiteSurvey of_points = test::survey_of_points(survey_);
    expect_bounds_at_every_stage(of_points, truth);
  }

  Choice choose_by_bounds(std::size_t count, bool with_zone) {
    SiteSurvey survey = survey_;
    if (!with_zone) survey.fresnel.reset();
    SiteCoverage coverage(*store_, survey, progress_);
    coverage.explore();
    std::vector<SiteOption> options;
    for (std::size_t i = 0; i < survey.positions.size(); ++i) options.push_back({i, 1});
    ChoiceGoal goal{.count = count};
    goal.swaps = false;
    return choose(Demand(element_count(*survey.targets.grid)), options, coverage, goal, progress_);
  }

  std::string path() { return directory_.file("s.itin"); }

  test::TemporaryDirectory directory_;
  std::optional<Store> store_;
  int side_ = 0;
  SiteSurvey survey_;
  double frequency_ghz_ = 1;
  std::size_t in_sight_ = 0;  ///< how many of the pairs asked about are in sight
  std::mt19937 random_{test::seed()};
  NoProgress progress_;
};

TEST_F(FresnelSites, BoundsHoldAndTheLastLookIsThatOfLines) {
  make_fractal(70, 150, true);
  make_survey(6);
  expect_law_four();
}

TEST_F(FresnelSites, AreKeptAsTheyAreJudged) {
  make_fractal(40, 100, false);
  make_survey(70);
  struct StopAfterFirst final : Progress {
    std::atomic<std::size_t> kept = 0;
    void report(std::string_view, double) override {}
    bool cancelled() const override { return kept > 0; }
  } progress;
  SiteCoverage coverage(*store_, survey_, progress);
  coverage.on_refined = [&](std::size_t, int, const CoverageBounds&) { ++progress.kept; };
  EXPECT_THROW(coverage.explore(), Cancelled);
  EXPECT_GT(progress.kept, 0U);
  EXPECT_LT(progress.kept, 70U);
}

TEST_F(FresnelSites, LikewiseAmongHouses) {
  make_fractal(40, 60, false);
  add_houses(60);
  make_survey(4);
  expect_law_four();
}

TEST_F(FresnelSites, LikewiseForTargetsOnRoofs) {
  make_fractal(40, 60, false);
  add_houses(60);
  survey_.targets.on_surface = true;
  make_survey(4);
  expect_law_four();
}

TEST_F(FresnelSites, TheChoiceIsThatOfBruteForce) {
  make_fractal(129, 200, false);
  make_survey(16);
  const std::vector<DemandSet> truth = all_served();
  const Demand demand(element_count(*survey_.targets.grid));
  const std::vector<std::size_t> slow = test::greedy_by_brute_force(truth, demand, 5);
  const Choice choice = choose_by_bounds(5, true);
  std::vector<std::size_t> chosen;
  for (const ChosenSite& site : choice.chosen) chosen.push_back(site.option);
  EXPECT_EQ(chosen, slow);
  EXPECT_EQ(choice.value, test::value_of(slow, truth, demand));
}

TEST_F(FresnelSites, TheZoneChangesTheChoice) {
  // A plain with a hill at its edge: a low mast in the middle sees all of it, along the ground; the hill but half.
  make_store(60, [](int c, int r) { return std::max(0.0, 120 - 30 * std::hypot(c - 1, r - 30)); });
  store_.emplace(path());
  const std::vector<Point2> positions{{kHillsCorner.x + 1500, kHillsCorner.y - 1500},
                                      {kHillsCorner.x + 75, kHillsCorner.y - 1525}};
  const auto ground = ground_under(*store_, positions, ThemeChoice::none(), progress_);
  survey_.positions = {{"plain", positions[0], 8, *ground[0]}, {"hill", positions[1], 8, *ground[1]}};
  survey_.radius = 1300;
  survey_.targets.height = 1.5;
  survey_.targets.grid = grid_of_reach(*store_, survey_.positions, survey_.radius, 50);
  frequency_ghz_ = 0.45;
  survey_.fresnel = FresnelCriterion{profile::wavelength_m(frequency_ghz_), 0.6};
  EXPECT_EQ(choose_by_bounds(1, false).chosen.at(0).option, 0U);
  EXPECT_EQ(choose_by_bounds(1, true).chosen.at(0).option, 1U);
  expect_law_four();
}

}  // namespace
}  // namespace itin::viewshed
