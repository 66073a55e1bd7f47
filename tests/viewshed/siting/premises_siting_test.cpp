// Sites for premises, against brute force: all candidates surveyed as masts, and every choice tried.
#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <itin/error.hpp>
#include <itin/import.hpp>
#include <viewshed/premises.hpp>
#include <viewshed/site_plan.hpp>

#include "support/alexandria.hpp"
#include "support/houses.hpp"
#include "support/raster_file.hpp"
#include "support/seed.hpp"
#include "support/slow_greedy.hpp"
#include "support/temporary_directory.hpp"

namespace itin::viewshed {
namespace {

class SitesForPremises : public testing::Test {
 protected:
  /// Level ground of 400 m by 400 m with 36 houses, and candidates in the streets between them.
  SitePlanRequest build_town() {
    std::mt19937_64 random(test::seed());
    const auto in = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
    test::write_raster(file("t.tif"), {300000, 200400, 10, 41, 41, 27700}, [](int, int) { return 50.0; });
    ImportOptions terrain;
    terrain.sources = {file("t.tif")};
    import_terrain(file("s.itin"), terrain, progress_);
    std::vector<test::LineFeature> houses;
    for (int row = 0; row < 6; ++row)
      for (int column = 0; column < 6; ++column)
        houses.push_back(test::turned_box({300040 + column * 60 + in(0, 15), 200040 + row * 60 + in(0, 15)}, in(8, 22),
                                          in(6, 14), in(0, 3), in(3, 14)));
    test::import_houses(file("s.itin"), file("h.geojson"), houses);
    SitePlanRequest request;
    for (int i = 0; i < 9; ++i)
      request.candidates.places.push_back(
          {.name = std::to_string(i),
           .position = {300015 + 120.0 * (i % 3) + in(0, 8), 200015 + 120.0 * (i / 3) + in(0, 8)}});
    request.masts = {{.height = in(5, 12)}};
    request.demand.premises = {.spacing = 4};
    request.themes = ThemeChoice::all();
    request.radius = in(90, 160), request.cell_size = 5;
    request.count = 3;
    return request;
  }

  /// The buildings that each candidate serves, by a survey of all of them.
  std::vector<DemandSet> served_by_each(const SitePlanRequest& request, std::size_t& buildings) {
    PremisesRequest all;
    static_cast<AntennaPlaces&>(all) = *request.demand.premises;
    all.masts = request.candidates;
    all.mast_height = request.masts.front().height;
    all.radius = request.radius, all.themes = request.themes, all.earth = request.earth;
    all.frequency_ghz = request.frequency_ghz, all.fresnel = request.fresnel;
    const PremisesSurvey survey = survey_premises(Store(file("s.itin")), all, progress_);
    buildings = survey.premises.size();
    std::vector<std::vector<std::uint64_t>> members(survey.masts.size(),
                                                    std::vector<std::uint64_t>(buildings / 64 + 1));
    for (std::size_t i = 0; i < buildings; ++i)
      for (const PremisesLink& link : survey.premises[i].links)
        if (link.verdict == Verdict::kVisible) members[link.mast][i / 64] |= std::uint64_t{1} << i % 64;
    std::vector<DemandSet> served(members.size());
    for (std::size_t m = 0; m < members.size(); ++m)
      for (std::size_t b = 0; b < members[m].size(); ++b) served[m].add(static_cast<std::uint32_t>(b), members[m][b]);
    return served;
  }

  /// The most that three of the candidates serve.
  static Weight best_of_three(const std::vector<DemandSet>& served, const Demand& demand) {
    Weight best = 0;
    for (std::size_t a = 0; a < served.size(); ++a)
      for (std::size_t b = a + 1; b < served.size(); ++b)
        for (std::size_t c = b + 1; c < served.size(); ++c)
          best = std::max(best, test::value_of({a, b, c}, served, demand));
    return best;
  }

  void expect_brute_force(SitePlanRequest request) {
    std::size_t buildings = 0;
    const std::vector<DemandSet> served = served_by_each(request, buildings);
    const Demand demand(buildings);
    const Weight best = best_of_three(served, demand);
    EXPECT_GT(best, 5);
    for (const std::uint64_t memory : {std::uint64_t{1} << 30, std::uint64_t{8} << 20}) {
      request.memory_bytes = memory;
      const SitePlan plan = plan_sites(Store(file("s.itin")), request, progress_);
      EXPECT_EQ(plan.choice.value, best);
      std::vector<std::size_t> chosen;
      for (const ChosenSite& site : plan.choice.chosen) chosen.push_back(site.option);
      EXPECT_EQ(test::value_of(chosen, served, demand), best);
      ASSERT_TRUE(plan.premises);
      EXPECT_EQ(plan.premises->counts().served(), static_cast<std::size_t>(best));
      EXPECT_EQ(plan.premises->masts.size(), chosen.size());
    }
  }

  std::string file(const std::string& name) const { return directory_.file(name); }

  test::TemporaryDirectory directory_;
  NoProgress progress_;
};

TEST_F(SitesForPremises, AreThoseOfBruteForce) {
  expect_brute_force(build_town());
}

TEST_F(SitesForPremises, NeedAClearZoneWithAFrequency) {
  SitePlanRequest request = build_town();
  request.frequency_ghz = 2.4, request.earth = Earth::effective_earth(4.0 / 3);
  expect_brute_force(request);
}

TEST_F(SitesForPremises, AreThoseOfGreedyChoiceInATown) {
  test::import_alexandria(file("s.itin"));
  SitePlanRequest request;
  for (int i = 0; i < 12; ++i)
    request.candidates.places.push_back(
        {.name = std::to_string(i), .position = {321590 + 35.0 * i, 4297655 + 60.0 * (i % 4)}, .height = 16});
  request.demand.premises = {.spacing = 4};
  request.themes = ThemeChoice::all();
  request.radius = 120, request.cell_size = 10, request.count = 5, request.swaps = false;
  std::size_t buildings = 0;
  SitePlanRequest open = request;
  // Candidates beneath roofs serve nothing, and are no masts that a survey takes.
  std::erase_if(open.candidates.places, [&](const SitePlace& place) {
    const Store store(file("s.itin"));
    const auto bare = ground_under(store, {place.position}, ThemeChoice::none(), progress_)[0];
    const auto top = ground_under(store, {place.position}, request.themes, progress_)[0];
    return !bare || *bare + *place.height < *top;
  });
  const std::vector<DemandSet> served = served_by_each(open, buildings);
  const Demand demand(buildings);
  const std::vector<std::size_t> greedy = test::greedy_by_brute_force(served, demand, 5);
  const SitePlan plan = plan_sites(Store(file("s.itin")), request, progress_);
  ASSERT_EQ(plan.choice.chosen.size(), greedy.size());
  for (std::size_t i = 0; i < greedy.size(); ++i)
    EXPECT_EQ(plan.place_of(plan.choice.chosen[i]).name, open.candidates.places[greedy[i]].name);
  EXPECT_EQ(plan.choice.value, test::value_of(greedy, served, demand));
}

TEST_F(SitesForPremises, RefuseWhatMakesNoSense) {
  SitePlanRequest request = build_town();
  const auto expect_refused = [&](const SitePlanRequest& wrong, const char* text) {
    try {
      std::ignore = plan_sites(Store(file("s.itin")), wrong, progress_);
      ADD_FAILURE() << text;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(text), std::string::npos) << error.what();
    }
  };
  SitePlanRequest wrong = request;
  wrong.themes = ThemeChoice::none();
  expect_refused(wrong, "`themes`: none of them has buildings");
  wrong = request, wrong.demand.premises->spacing = 0;
  expect_refused(wrong, "`spacing`: give 0.1 m or more");
  wrong = request, wrong.radius = 10;
  expect_refused(wrong, "no building is within the `radius` of 10 m of a site");
  wrong = request, wrong.demand.points.emplace();
  expect_refused(wrong, "the demand is either `points`, a `grid` or `premises`");
  wrong = request, wrong.turbines.emplace();
  expect_refused(wrong, "`turbines`");
}

}  // namespace
}  // namespace itin::viewshed
