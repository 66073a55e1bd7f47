// The choice among candidate sites of which bounds are known first, against brute force on what each serves.
#pragma once

#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include <viewshed/site_coverage.hpp>

#include "support/full_detail.hpp"
#include "support/slow_greedy.hpp"
#include "support/subset.hpp"

namespace itin::test {

using namespace viewshed;

inline DemandSet seen_in(const RasterGrid& grid, const std::vector<Verdict>& values) {
  DemandSet set;
  for (std::size_t block = 0; block < element_count(grid) / 64; ++block) {
    std::uint64_t members = 0;
    for (std::size_t bit = 0; bit < 64; ++bit) {
      const RasterGrid::Cell cell = cell_of(grid, 64 * block + bit);
      if (cell.column < grid.columns() && cell.row < grid.rows() && values[grid.index(cell)] == Verdict::kVisible)
        members |= std::uint64_t{1} << bit;
    }
    set.add(static_cast<std::uint32_t>(block), members);
  }
  return set;
}

/// What each site serves, by a viewshed over the whole surface from the ground.
inline std::vector<DemandSet> exact_coverage(const Store& store, const SiteSurvey& survey) {
  Request request;
  request.target_height = survey.targets.height;
  request.radius = survey.radius;
  request.grid = survey.targets.grid;
  request.themes = survey.themes;
  request.nodata = survey.nodata;
  NoProgress progress;
  std::vector<DemandSet> truth;
  for (const SitePosition& place : survey.positions) {
    request.observers = {{place.name, place.position, place.height}};
    truth.push_back(seen_in(*request.grid, compute_at_full_detail(store, request, {}, progress).result.visible));
  }
  return truth;
}

inline void expect_bounds_hold(const CoverageBounds& bounds, const DemandSet& truth) {
  EXPECT_TRUE(is_subset(bounds.certain, truth));
  EXPECT_TRUE(is_subset(truth, bounds.possible));
  EXPECT_TRUE(!bounds.exact || (bounds.certain == truth && bounds.possible == truth));
}

/// Expects bounds to come first, and to hold, and the choice on them to be that of brute force. Returns how many sites
/// were judged again.
inline std::size_t expect_choice(const Store& store, const SiteSurvey& survey, const std::vector<DemandSet>& truth,
                                 std::size_t count) {
  NoProgress progress;
  SiteCoverage coverage(store, survey, progress);
  EXPECT_EQ(coverage.last_stage(), 1);
  EXPECT_EQ(coverage.stage_name(0), "bounds, with themes");
  EXPECT_EQ(coverage.stage_name(1), "exact, with themes");
  coverage.explore();
  for (std::size_t i = 0; i < truth.size(); ++i) {
    EXPECT_FALSE(coverage.bounds(i).exact);
    expect_bounds_hold(coverage.bounds(i), truth[i]);
  }
  const Demand demand(element_count(*survey.targets.grid));
  std::vector<SiteOption> options;
  for (std::size_t i = 0; i < truth.size(); ++i) options.push_back({i, 1});
  ChoiceGoal goal{.count = count};
  goal.swaps = false;
  const Choice choice = choose(demand, options, coverage, goal, progress);
  std::vector<std::size_t> chosen;
  for (const ChosenSite& site : choice.chosen) chosen.push_back(site.option);
  EXPECT_EQ(chosen, greedy_by_brute_force(truth, demand, count));
  std::size_t again = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    expect_bounds_hold(coverage.bounds(i), truth[i]);
    again += coverage.stage(i) > 0;
  }
  return again;
}

}  // namespace itin::test
