// What every long call of the library tells of its progress: one fraction that never decreases and ends at 1.
#include <gtest/gtest.h>

#include <itin/triangulate.hpp>
#include <viewshed/held_surface.hpp>
#include <viewshed/horizon.hpp>
#include <viewshed/plan.hpp>
#include <viewshed/site_coverage.hpp>
#include <viewshed/site_proposal.hpp>
#include <viewshed/surface.hpp>
#include <viewshed/turbines.hpp>
#include <viewshed/visibility_index.hpp>

#include "support/hills_and_town.hpp"
#include "support/told_progress.hpp"

namespace itin::viewshed {
namespace {

class ProgressOfViewsheds : public testing::Test {
 protected:
  static void SetUpTestSuite() { stores_ = new test::HillsAndTown; }
  static void TearDownTestSuite() {
    delete stores_;
    stores_ = nullptr;
  }

  template <class Call>
  static void expect_whole(const char* what, const Call& call, double most = 0.7) {
    SCOPED_TRACE(what);
    test::ToldProgress told;
    call(told);
    told.expect_whole_call();
    told.expect_steps_up_to(most);
  }

  static void expect_whole_viewsheds(const Store& store, const Request& request, std::uint64_t few_bytes) {
    expect_whole("at once", [&](Progress& p) { std::ignore = compute(store, request, p); });
    for (const bool lattices : {true, false})
      expect_whole("in segments", [&](Progress& p) {
        std::ignore = compute_with_surface(store, request, {.memory_bytes = few_bytes, .lattices = lattices}, p).result;
      });
    for (const double tolerance : {0.0, 4.0, 16.0}) {
      Request certified = request;
      certified.detail = Detail::tolerance(tolerance);
      expect_whole("certified", [&](Progress& p) { std::ignore = compute_certified(store, certified, {}, p).result; });
    }
    const Plan plan(store, request, {}, 5000);
    expect_whole("segment", [&](Progress& p) { std::ignore = decide(store, plan, 0, p); });
    PagedSurface pages(store, request.detail, request.themes);
    for (int round = 0; round < 2; ++round)
      expect_whole("paged", [&](Progress& p) { std::ignore = pages.compute(request, p); });
    expect_whole("held", [&](Progress& p) {
      const HeldSurface surface(store, extent_of(store), request.detail, request.themes, {}, p);
    });
  }

  static inline test::HillsAndTown* stores_ = nullptr;
  NoProgress progress_;
};

TEST_F(ProgressOfViewsheds, NeverFallsBackAndEndsAtOne) {
  expect_whole_viewsheds(Store(stores_->hills()), test::HillsAndTown::over_hills(), 3000000);
  expect_whole_viewsheds(Store(stores_->town()), test::HillsAndTown::over_town(), 6000000);
}

TEST_F(ProgressOfViewsheds, IsThatOfEveryOtherCallToo) {
  const Store store(stores_->hills());
  const Request request = test::HillsAndTown::over_hills();
  const Tin tin = triangulate(store, Window::all(), Detail::tolerance(0), progress_);
  Request one = request;
  one.observers.resize(1);
  expect_whole("horizon", [&](Progress& p) { std::ignore = horizon(tin, tin, one, {}, p); });
  for (const std::uint64_t memory : {std::uint64_t{1} << 30, std::uint64_t{3000000}})
    for (const double tolerance : {0.0, 2.0}) {
      IndexRequest index;
      index.area = Window::all();
      index.cell_size = 200;
      index.radius = 800;
      index.memory_bytes = memory;
      index.detail = Detail::tolerance(tolerance);
      expect_whole("visibility index", [&](Progress& p) { std::ignore = visibility_index(store, index, p); });
    }
  ZoneRequest zone;
  for (const std::size_t number : {1, 2})
    zone.turbines.push_back(
        {number, "", "", {301500 + 800.0 * static_cast<double>(number), 202500}, 120, 80, 80, 1500});
  zone.cell_size = 25;
  expect_whole("turbines", [&](Progress& p) { std::ignore = survey_turbines(store, zone, p); });
}

TEST_F(ProgressOfViewsheds, IsThatOfSitingToo) {
  const Store store(stores_->hills());
  SiteSurvey survey;
  survey.radius = 1000;
  survey.targets.height = 2;
  expect_whole("proposal", [&](Progress& p) {
    ProposalRequest request;
    request.spacing = 500;
    request.radius = 500;
    for (const Proposal& site : propose_sites(store, Window::box({302000, 200500, 303500, 203500}), request, p))
      survey.positions.push_back({"", site.position, 20});
  });
  survey.targets.grid = grid_of_reach(store, survey.positions, survey.radius, 20);
  expect_whole(
      "ground", [&](Progress& p) { std::ignore = with_ground(store, survey.targets, p); }, 1);
  for (const std::uint64_t memory : {std::uint64_t{1} << 30, std::uint64_t{8} << 20}) {
    survey.memory_bytes = memory;
    test::ToldProgress told;
    SiteCoverage coverage(store, survey, told);
    std::size_t before = told.all().size();
    coverage.explore();
    std::vector<double> all(told.all().begin() + static_cast<std::ptrdiff_t>(before), told.all().end());
    EXPECT_TRUE(std::is_sorted(all.begin(), all.end()));
    EXPECT_EQ(all.back(), 1);
  }
}

}  // namespace
}  // namespace itin::viewshed
