// Choices of sites in tasks, answered in whatever order by others, against choices in one call.
#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <itin/byte_archive.hpp>
#include <itin/error.hpp>
#include <itin/import.hpp>
#include <viewshed/premises.hpp>
#include <viewshed/site_tasks.hpp>

#include "support/houses.hpp"
#include "support/raster_file.hpp"
#include "support/seed.hpp"
#include "support/temporary_directory.hpp"

namespace itin::viewshed {
namespace {

/// Hills of 1,300 m by 1,000 m with houses and a hole, and candidates all over them.
class SitesInTasks : public testing::Test {
 protected:
  void SetUp() override {
    std::mt19937_64 random(test::seed());
    const auto in = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
    const std::vector<double> z = test::fractal_heights(65, 60, 0.6, test::seed());
    test::write_raster(file("t.tif"), {300000, 201000, 20, 65, 50, 27700}, [&](int c, int r) {
      if (std::hypot(c - 30, r - 8) < 3) return std::nan("");
      return z[static_cast<std::size_t>(r) * 65 + static_cast<std::size_t>(c)];
    });
    ImportOptions terrain;
    terrain.sources = {file("t.tif")};
    import_terrain(file("s.itin"), terrain, progress_);
    std::vector<test::LineFeature> houses;
    for (int i = 0; i < 25; ++i)
      houses.push_back(test::turned_box({300120 + 240.0 * (i % 5) + in(0, 60), 200120 + 170.0 * (i / 5) + in(0, 60)},
                                        in(8, 22), in(6, 14), in(0, 3), in(3, 14)));
    test::import_houses(file("s.itin"), file("h.geojson"), houses);
    store_.emplace(file("s.itin"));
    for (int i = 0; i < 30; ++i) {
      const Point2 place{300060 + 230.0 * (i % 6) + in(0, 60), 200060 + 180.0 * (i / 6) + in(0, 60)};
      asked_.candidates.places.push_back({.name = std::to_string(i), .position = place});
    }
    std::shuffle(asked_.candidates.places.begin(), asked_.candidates.places.end(), random);
    asked_.masts = {{.height = in(5, 20)}};
    asked_.radius = in(200, 400);
    asked_.cell_size = 20;
    asked_.count = 4;
  }

  std::string file(const std::string& name) const { return directory_.file(name); }

  void ask_for_points() {
    asked_.demand.points.emplace();
    for (int i = 0; i < 150; ++i)
      asked_.demand.points->places.push_back({.name = "P" + std::to_string(i),
                                              .position = {300055.0 + i * 97 % 1190, 200945.0 - i * 53 % 890},
                                              .height = 1.0 + i % 9,
                                              .weight = 1.0 + i % 3});
  }
  void ask_for_turbines(Minimised minimised) {
    asked_.turbines = TurbinePlacement{.hub_height = 40, .rotor_diameter = 30, .tip_height = 55};
    asked_.turbines->minimised = minimised;
  }

  /// Plans in tasks, the last one first, all of them by other objects than the one that puts them together.
  SitePlan plan_in_tasks(std::uint64_t most_sites) {
    const Store store(file("s.itin"));
    SiteTasks tasks(store, asked_, most_sites, progress_);
    EXPECT_GT(tasks.list().size(), 1U);
    for (std::size_t i = tasks.list().size(); i-- > 0;) {
      EXPECT_LE(tasks.list()[i].cells(), most_sites);
      const SiteTasks other(store, asked_, most_sites, progress_);
      tasks.add(i, other.answer(i, progress_));
    }
    return tasks.take(progress_);
  }

  static std::vector<Weight> gains(const SitePlan& plan) {
    std::vector<Weight> all;
    for (const ChosenSite& site : plan.choice.chosen)
      all.insert(all.end(), {static_cast<Weight>(site.option), site.gain, site.cumulative});
    const Choice& c = plan.choice;
    all.insert(all.end(), {c.value, c.lower_bound, c.upper_bound, c.existing, static_cast<Weight>(c.swaps)});
    return all;
  }
  static std::vector<std::string> surveyed(const SitePlan& plan) {
    std::vector<std::string> all;
    for (const OptionSurvey& s : plan.surveys)
      all.push_back(std::to_string(s.first.certain) + " " + std::to_string(s.first.possible) + " " +
                    std::to_string(s.last.certain) + " " + std::to_string(s.last.possible) + " " +
                    std::to_string(s.stage) + s.looked_at);
    return all;
  }

  /// Returns the plan of the whole call.
  SitePlan expect_tasks_make_the_whole(const std::vector<std::uint64_t>& numbers_of_sites = {7}) {
    const SitePlan whole = plan_sites(*store_, asked_, progress_);
    EXPECT_FALSE(whole.choice.chosen.empty());
    for (const std::uint64_t most : numbers_of_sites) {
      SCOPED_TRACE(most);
      const SitePlan merged = plan_in_tasks(most);
      EXPECT_EQ(gains(merged), gains(whole));
      EXPECT_EQ(surveyed(merged), surveyed(whole));
      EXPECT_EQ(json_of(merged, store_->metadata()), json_of(whole, store_->metadata()));
      EXPECT_EQ(merged.rasters.redundancy, whole.rasters.redundancy);
      EXPECT_EQ(merged.rasters.best_server, whole.rasters.best_server);
      EXPECT_EQ(merged.rasters.served, whole.rasters.served);
      EXPECT_EQ(merged.warnings, whole.warnings);
      if (whole.all_exact() && !whole.heights) {
        EXPECT_EQ(merged.statistics.lines, 0U) << "tasks looked at all sites";
      }
      if (refined(whole) > 0) {
        EXPECT_LT(merged.statistics.lines, whole.statistics.lines);
      }
      EXPECT_EQ(merged.inputs.left_out, whole.inputs.left_out);
      EXPECT_EQ(merged.premises != nullptr, whole.premises != nullptr);
      EXPECT_EQ(merged.points.size(), whole.points.size());
      for (std::size_t i = 0; i < merged.points.size(); ++i) {
        EXPECT_EQ(merged.points[i].service, whole.points[i].service);
        EXPECT_EQ(merged.points[i].serving, whole.points[i].serving);
      }
    }
    return whole;
  }
  static std::size_t refined(const SitePlan& plan) { return plan.refined(); }

  test::TemporaryDirectory directory_;
  std::optional<Store> store_;
  SitePlanRequest asked_;
  NoProgress progress_;
};

TEST_F(SitesInTasks, AreThoseOfOneCall) {
  EXPECT_TRUE(expect_tasks_make_the_whole({1, 7}).all_exact());
  asked_.nodata = NoData::kBlock;
  asked_.existing.places = {{.name = "old", .position = {300710, 200110}, .height = 5}};
  asked_.cover = 2;
  expect_tasks_make_the_whole();
}

TEST_F(SitesInTasks, LikewiseAfterACoarseLook) {
  asked_.tolerance = 16;
  EXPECT_GT(refined(expect_tasks_make_the_whole()), 0U);
  asked_.themes = ThemeChoice::all();
  const SitePlan themed = expect_tasks_make_the_whole();
  EXPECT_GE(themed.stages.size(), 2U);
}

TEST_F(SitesInTasks, LikewiseWhereTheMemoryHoldsNoSurface) {
  asked_.memory_bytes = 1300000;
  const SitePlan bare = expect_tasks_make_the_whole();
  asked_.themes = ThemeChoice::all();
  const SitePlan themed = expect_tasks_make_the_whole();
  EXPECT_EQ(themed.stages.front().name, "bounds, with themes");
  EXPECT_GT(refined(themed), 0U);
}

TEST_F(SitesInTasks, LikewiseForPoints) {
  ask_for_points();
  asked_.themes = ThemeChoice::all();
  expect_tasks_make_the_whole();
  asked_.tolerance = 8;
  expect_tasks_make_the_whole();
}

TEST_F(SitesInTasks, LikewiseForClearZonesLinksAndLevels) {
  asked_.frequency_ghz = 2.4;
  asked_.tolerance = 8;
  expect_tasks_make_the_whole();
  asked_.masts = {{.height = 60}};
  asked_.hub = SitePlace{.position = {300390, 200390}, .height = 70};
  const SitePlan linked = expect_tasks_make_the_whole();
  EXPECT_FALSE(linked.routes.empty());
  asked_.tolerance.reset();
  asked_.link_budget = {.power_dbm = 0, .sensitivity_dbm = -85};
  expect_tasks_make_the_whole();
  ask_for_points();
  expect_tasks_make_the_whole();
}

TEST_F(SitesInTasks, LikewiseForPremises) {
  asked_.demand.premises = {.spacing = 4};
  asked_.themes = ThemeChoice::all();
  EXPECT_TRUE(expect_tasks_make_the_whole().premises);
}

TEST_F(SitesInTasks, LikewiseInASearchArea) {
  asked_.candidates = {};
  asked_.search_area = Window::box({300100, 200100, 301200, 200900});
  asked_.spacing = 200;
  expect_tasks_make_the_whole();
}

TEST_F(SitesInTasks, LikewiseForTurbines) {
  for (const Minimised minimised : {Minimised::kTips, Minimised::kHubs}) {
    ask_for_turbines(minimised);
    expect_tasks_make_the_whole();
  }
  ask_for_points();
  expect_tasks_make_the_whole();
}

TEST_F(SitesInTasks, LikewiseForTheHeightsThatTurbinesShow) {
  ask_for_turbines(Minimised::kHeight);
  EXPECT_TRUE(expect_tasks_make_the_whole().heights);
  asked_.themes = ThemeChoice::all();
  expect_tasks_make_the_whole();
  asked_.nodata = NoData::kBlock;
  expect_tasks_make_the_whole();
  ask_for_points();
  expect_tasks_make_the_whole();
}

/// What tasks answer is what the choice is made by, each sum for its own turbine.
TEST_F(SitesInTasks, AreChosenByTheHeightsThatWereAnswered) {
  ask_for_turbines(Minimised::kHeight);
  SiteTasks tasks(*store_, asked_, 7, progress_);
  double least = 1000;
  for (std::size_t i = tasks.list().size(); i-- > 0;) {
    std::vector<double> heights_m(tasks.list()[i].cells());
    for (double& height_m : heights_m) height_m = least--;
    ValueWriter writer;
    writer(heights_m);
    tasks.add(i, writer.bytes());
  }
  const SitePlan plan = tasks.take(progress_);
  ASSERT_EQ(plan.choice.chosen.size(), 4U);
  EXPECT_EQ(plan.in_metric(plan.choice.value), 4 * least + 10);
  Box box;
  for (const ChosenSite& site : plan.choice.chosen) box.extend(plan.place_of(site).position);
  EXPECT_LT(box.width() + box.height(), 1300) << "these are sites of the first task, which are neighbours";
}

TEST_F(SitesInTasks, AnswerTheSameTwiceAndAfterOthers) {
  asked_.tolerance = 16;
  const SiteTasks tasks(*store_, asked_, 7, progress_), others(*store_, asked_, 7, progress_);
  const std::string first = others.answer(2, progress_);
  for (std::size_t i = 0; i < tasks.list().size(); ++i) std::ignore = tasks.answer(i, progress_);
  EXPECT_EQ(tasks.answer(2, progress_), first);
  EXPECT_EQ(others.answer(2, progress_), first);
}

TEST_F(SitesInTasks, RefuseOtherAnswers) {
  for (const bool heights : {false, true}) {
    if (heights) ask_for_turbines(Minimised::kHeight);
    SiteTasks tasks(*store_, asked_, 7, progress_);
    const std::string answer = tasks.answer(0, progress_);
    EXPECT_THROW(tasks.add(0, answer.substr(0, answer.size() - 1)), NotThoseValues);
    EXPECT_THROW(tasks.add(0, answer + "x"), NotThoseValues);
    EXPECT_THROW(tasks.add(0, ""), NotThoseValues);
  }
}

TEST_F(SitesInTasks, AreRefusedAsTheCallIs) {
  asked_.radius = 0;
  EXPECT_THROW(SiteTasks(*store_, asked_, 7, progress_), InputError);
}

}  // namespace
}  // namespace itin::viewshed
