// A choice of sites by the library against the one of `itin site`: the files have the same bytes.
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include <gtest/gtest.h>

#include <itin/document.hpp>
#include <viewshed/site_plan.hpp>

#include "cli/shell.hpp"

namespace itin::test {

namespace {

namespace fs = std::filesystem;

constexpr Point2 kPlaces[] = {{300400, 170500}, {301600, 171500}, {301025, 171025}, {300500, 171700}, {301800, 170300}};

std::string bytes_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Runs a command that must succeed.
void call(const Shell& shell, const std::string& command) {
  const Outcome outcome = shell.run(command);
  ASSERT_EQ(outcome.status, 0) << outcome.err;
}

/// Compares what the library makes of the request with what the call wrote into the folder `called`.
void expect_agreement(const Shell& shell, viewshed::SitePlanRequest request) {
  const Store store((shell.directory() / "hill.itin").string());
  for (const Point2 place : kPlaces)
    request.candidates.places.push_back({.name = std::to_string(request.candidates.places.size()), .position = place});
  request.themes = ThemeChoice::all();
  NoProgress progress;
  const viewshed::SitePlan plan = viewshed::plan_sites(store, request, progress);
  const Document called = Document::parse(shell.read("called/site.json"));
  const Document planned = Document::parse(viewshed::json_of(plan, store.metadata()));
  for (const auto& [name, value] : planned.items()) EXPECT_EQ(called.at(name), value) << name;
  Document parameters = called.at("command");
  parameters.erase("verb");
  const auto written = viewshed::write_site_plan(
      (shell.directory() / "planned").string(), plan, store, progress,
      {.metadata = {{"itin", called.at("itin").get<std::string>()}, {"parameters", json_text(parameters)}}});
  EXPECT_GE(written.size(), 9U);
  for (const viewshed::PlanFile& file : written)
    EXPECT_TRUE(bytes_of(file.path) == bytes_of(shell.directory() / "called" / fs::path(file.path).filename()))
        << file.path;
}

class SitePlanAgrees : public testing::Test {
 protected:
  void SetUp() override {
    write_hill(shell_.directory() / "hill.asc");
    call(shell_, "itin import hill.itin hill.asc --quiet");
    std::ofstream table(shell_.directory() / "c.csv");
    table << "x,y\n";
    for (const Point2 place : kPlaces) table << place.x << ',' << place.y << '\n';
  }

  const Shell shell_;
};

TEST_F(SitePlanAgrees, OnMastsAndTheirRoutesToTheHub) {
  call(shell_,
       "itin site hill.itin --candidates c.csv --mast-height 15,30 --mast-cost 1,2 --budget 5 --radius 800 --cell 25 "
       "--hub 301000,171500,25 --swap off -o called --quiet");
  viewshed::SitePlanRequest request;
  request.masts = {{15, 1}, {30, 2}};
  request.budget = 5;
  request.radius = 800;
  request.cell_size = 25;
  request.hub = viewshed::SitePlace{.position = {301000, 171500}, .height = 25};
  request.swaps = false;
  expect_agreement(shell_, std::move(request));
}

TEST_F(SitePlanAgrees, OnTurbinesThatAreSeenLeast) {
  call(shell_,
       "itin site hill.itin --turbines --candidates c.csv --hub-height 40 --rotor-diameter 30 --rotor-spacing 4 "
       "--count 2 --radius 900 --cell 30 --nodata block -o called --quiet");
  viewshed::SitePlanRequest request;
  request.turbines = {.hub_height = 40, .rotor_diameter = 30, .tip_height = 55, .spacing = {{120, 120, 0}}};
  request.count = 2;
  request.radius = 900;
  request.cell_size = 30;
  request.nodata = NoData::kBlock;
  expect_agreement(shell_, std::move(request));
}

}  // namespace

}  // namespace itin::test
