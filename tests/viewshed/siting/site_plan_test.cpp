// Plans of sites against a judgement cell by cell, with every triangle under every line.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <itin/error.hpp>
#include <itin/import.hpp>
#include <itin/triangulate.hpp>
#include <viewshed/site_links.hpp>
#include <viewshed/site_maps.hpp>
#include <viewshed/site_plan.hpp>

#include "support/brute_force_viewshed.hpp"
#include "support/houses.hpp"
#include "support/raster_file.hpp"
#include "support/seed.hpp"
#include "support/temporary_directory.hpp"
#include "support/terrain_tin.hpp"
#include "support/vector_file.hpp"

namespace itin::viewshed {
namespace {

/// Hills of 800 m by 800 m with some houses, and a hole.
class SitePlans : public testing::Test {
 protected:
  void SetUp() override {
    const std::vector<double> z = test::fractal_heights(65, 40, 0.6, test::seed());
    test::write_raster(file("t.tif"), {300000, 200800, 20, 40, 40, 27700}, [&](int c, int r) {
      if (std::hypot(c - 30, r - 8) < 3) return std::nan("");
      return z[static_cast<std::size_t>(r) * 65 + static_cast<std::size_t>(c)];
    });
    ImportOptions terrain;
    terrain.sources = {file("t.tif")};
    import_terrain(file("s.itin"), terrain, progress_);
    test::import_houses(file("s.itin"), file("h.geojson"),
                        {test::box(300100, 200300, 300140, 200330, 9), test::box(300400, 200500, 300420, 200540, 12),
                         test::box(300300, 200100, 300360, 200120, 7)});
    store_.emplace(file("s.itin"));
  }

  std::string file(const std::string& name) const { return directory_.file(name); }

  SitePlanRequest request() const {
    SitePlanRequest request;
    for (const Point2 p : {Point2{300110, 200610},
                           {300510, 200310},
                           {300290, 200210},
                           {300650, 200690},
                           {300050, 200110},
                           {300410, 200450}})
      request.candidates.places.push_back({.name = std::to_string(request.candidates.places.size()), .position = p});
    request.masts = {{.height = 15}};
    request.existing.places = {{.name = "old", .position = {300710, 200110}, .height = 5}};
    request.radius = 300;
    request.cell_size = 20;
    request.count = 3;
    request.themes = ThemeChoice::all();
    request.nodata = NoData::kClear;  // as test::brute_force()
    return request;
  }

  SitePlan plan(const SitePlanRequest& request) { return plan_sites(*store_, request, progress_); }

  /// Returns what a site sees of the raster's cells.
  std::vector<Verdict> seen_from(const SitePlan& plan, const SitePosition& site) {
    if (!surface_) {
      surface_ = triangulate(*store_, Window::all(), Detail::tolerance(0), progress_, plan.request.themes);
      ground_ = triangulate(*store_, Window::all(), Detail::tolerance(0), progress_);
    }
    Request look = test::look(site.position, site.height, plan.request.demand.height, plan.request.cell_size);
    look.radius = plan.request.radius;
    return test::brute_force(*surface_, *ground_, look, plan.rasters.grid);
  }

  /// The rasters cell by cell: each site in turn, the nearest first seen.
  void expect_true_rasters(const SitePlan& plan) {
    std::vector<SitePosition> sites;
    for (const ChosenSite& chosen : plan.choice.chosen) sites.push_back(plan.place_of(chosen));
    for (std::size_t i = plan.inputs.options.size(); i < plan.inputs.positions.size(); ++i)
      sites.push_back(plan.inputs.positions[i]);
    std::vector<std::vector<Verdict>> seen;
    for (const SitePosition& site : sites) seen.push_back(seen_from(plan, site));
    const RasterGrid& grid = plan.rasters.grid;
    std::size_t served = 0, overlaps = 0;
    for (std::int64_t row = 0; row < grid.rows(); ++row) {
      for (std::int64_t column = 0; column < grid.columns(); ++column) {
        const std::size_t cell = grid.index({column, row});
        const Point2 centre = grid.centre(column, row);
        int best = 0, count = 0;
        double nearest = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < sites.size(); ++i) {
          if (seen[i][cell] != Verdict::kVisible) continue;
          ++count;
          const double distance = std::hypot(centre.x - sites[i].position.x, centre.y - sites[i].position.y);
          if (distance < nearest) nearest = distance, best = static_cast<int>(i) + 1;
        }
        if (plan.rasters.served[cell] == Verdict::kOutside) {
          EXPECT_EQ(plan.rasters.best_server[cell], SiteRasters::kOutside);
          continue;
        }
        EXPECT_EQ(plan.rasters.best_server[cell], best) << column << ' ' << row;
        EXPECT_EQ(plan.rasters.redundancy[cell], count) << column << ' ' << row;
        EXPECT_EQ(plan.rasters.served[cell] == Verdict::kVisible, count >= plan.request.cover) << column << ' ' << row;
        served += count > 0, overlaps += count > 1;
      }
    }
    EXPECT_GT(served, 50U);
    EXPECT_GT(overlaps, 3U);
  }

  /// Returns the number of cells with ground within the radius of a candidate.
  std::size_t cells_in_reach(const SitePlan& plan) {
    std::size_t count = 0;
    std::vector<char> reached(plan.rasters.grid.cell_count());
    for (std::size_t i = 0; i < plan.inputs.options.size(); ++i) {
      const std::vector<Verdict> seen = seen_from(plan, plan.inputs.positions[i]);
      for (std::size_t cell = 0; cell < seen.size(); ++cell)
        if (seen[cell] != Verdict::kOutside) reached[cell] = 1;
    }
    for (const char one : reached) count += one;
    return count;
  }

  test::TemporaryDirectory directory_;
  std::optional<Store> store_;
  std::optional<Tin> surface_, ground_;
  NoProgress progress_;
};

TEST_F(SitePlans, ServeEachCellByTheNearestSiteThatSeesIt) {
  SitePlanRequest asked = request();
  expect_true_rasters(plan(asked));
  asked.cover = 2;
  expect_true_rasters(plan(asked));
}

TEST_F(SitePlans, CountTheDemandThatTheSitesServe) {
  const SitePlan made = plan(request());
  ASSERT_EQ(made.choice.chosen.size(), 3U);
  EXPECT_EQ(static_cast<std::size_t>(made.inputs.total), cells_in_reach(made));
  // Every cell of the demand counts as 1, and existing sites may serve cells that no candidate reaches.
  std::size_t served = 0;
  for_each_element(made.inputs.cells, [&](std::size_t element) {
    served += made.rasters.served[made.rasters.grid.index(cell_of(made.rasters.grid, element))] == Verdict::kVisible;
  });
  EXPECT_EQ(made.served(), static_cast<double>(served));
  EXPECT_EQ(made.surveys.size(), made.inputs.options.size());
  EXPECT_LE(made.choice.value, made.choice.upper_bound);
}

TEST_F(SitePlans, LinkSitesAndRouteThemToTheHub) {
  SitePlanRequest asked = request();
  asked.masts = {{.height = 60}};
  asked.hub = SitePlace{.position = {300390, 200390}, .height = 70};
  const SitePlan made = plan(asked);
  ASSERT_FALSE(made.choice.chosen.empty());
  const std::size_t ends = made.choice.chosen.size() + 2;
  EXPECT_EQ(made.network.ends.size(), ends);
  EXPECT_EQ(made.network.links.size(), ends * (ends - 1) / 2);
  ASSERT_EQ(made.routes.size(), ends - 1);
  for (std::size_t i = 0; i < made.choice.chosen.size(); ++i) {
    ASSERT_FALSE(made.routes[i].hops.empty());
    EXPECT_EQ(made.routes[i].hops.front().from, i);
    EXPECT_EQ(made.routes[i].hops.back().to, ends - 1);
    for (const RouteHop& hop : made.routes[i].hops)
      EXPECT_EQ(made.network.links[hop.link].found().verdict, profile::SightVerdict::kVisible);
  }
}

TEST_F(SitePlans, KeepTheReasonForEachPlaceThatIsLeftOut) {
  SitePlanRequest asked = request();
  asked.candidates.source = "list";
  asked.candidates.places[0].cost = -1, asked.candidates.places[0].origin = "row 1";
  asked.candidates.places[1].position = {0, 0};
  asked.forbidden = Window::box({300280, 200200, 300300, 200220});
  const SitePlan made = plan(asked);
  ASSERT_EQ(made.inputs.left_out.size(), 3U);
  EXPECT_EQ(made.inputs.left_out[0], "list: row 1: its cost is missing or negative");
  EXPECT_EQ(made.inputs.left_out[1], "candidate 2: lies in a forbidden area");
  EXPECT_EQ(made.inputs.left_out[2], "candidate 1 at 0,0: it lies off the data");
  EXPECT_EQ(made.inputs.barred.size(), 1U);
  asked.candidates.source.clear(), asked.candidates.places[0].origin.clear();
  EXPECT_EQ(plan(asked).inputs.left_out[0], "candidate 0: its cost is missing or negative");
  EXPECT_EQ(made.inputs.candidates.size(), 3U);
}

TEST_F(SitePlans, TakeDemandOfPointsWithTheirOwnHeightsAndWeights) {
  SitePlanRequest asked = request();
  asked.demand.points.emplace();
  for (int i = 0; i < 20; ++i)
    asked.demand.points->places.push_back({.position = {300055.0 + 33 * i, 200745.0 - 31 * i},
                                           .height = i % 2 == 0 ? std::optional(4.0) : std::nullopt,
                                           .weight = static_cast<double>(1 + i % 3)});
  const std::vector<SitePlace> points = asked.demand.points->places;
  const SitePlan made = plan(asked);
  double total = 0;
  for (const SitePlace& point : points) total += point.weight;
  EXPECT_EQ(made.in_metric(made.inputs.total), total);
  EXPECT_EQ(made.request.demand.points->places.capacity(), 0U);  // the memory is free again
  EXPECT_GT(made.served(), 0);
  // Four points in place of each, with a quarter of its weight.
  asked.demand.points->places.clear();
  for (const SitePlace& point : points) {
    asked.demand.points->places.insert(asked.demand.points->places.end(), 4, point);
    for (std::size_t k = asked.demand.points->places.size() - 4; k < asked.demand.points->places.size(); ++k)
      asked.demand.points->places[k].weight /= 4;
  }
  EXPECT_EQ(plan(asked).served(), made.served());
}

/// Judges every line between a site and a point by itself.
TEST_F(SitePlans, TellOfEveryPointWhatSingleLinesTell) {
  for (const bool radio : {false, true}) {
    for (const NoData rule : {NoData::kClear, NoData::kUnknown}) {
      SitePlanRequest asked = request();
      asked.nodata = rule;
      asked.count = 2;
      if (radio) asked.frequency_ghz = 5.8;
      asked.cover = radio ? 1 : 2;
      asked.demand.points.emplace();
      for (int i = 0; i < 120; ++i)
        asked.demand.points->places.push_back({.name = "P" + std::to_string(i),
                                               .position = {300055.0 + i * 37 % 690, 200745.0 - i * 53 % 690},
                                               .height = 1.0 + i % 9});
      const SitePlan made = plan(asked);
      ASSERT_EQ(made.points.size(), 120U);
      const LinkRules rules = link_rules(made.request);
      std::size_t served = 0, unserved = 0;
      for (std::size_t i = 0; i < made.points.size(); ++i) {
        const PointResult& point = made.points[i];
        SCOPED_TRACE(point.point.name);
        EXPECT_EQ(point.point.name, "P" + std::to_string(i));
        std::size_t serving = 0, in_reach = 0;
        double nearest = std::numeric_limits<double>::infinity(), clearest = -nearest;
        for (std::size_t site = 0; site < made.network.ends.size(); ++site) {
          const SitePosition& mast = made.network.ends[site].place;
          const double distance = std::hypot(mast.position.x - point.place.position.x,  //
                                             mast.position.y - point.place.position.y);
          if (distance > asked.radius || point.service == PointService::kNoGround) continue;
          ++in_reach;
          profile::LinkQuery query = rules.query;
          query.to_on_surface = asked.demand.on_surface;
          const profile::LinkResult line = survey_link(*store_, link_between(mast, point.place), query);
          if (rules.met_by(*line.found)) ++serving, nearest = std::min(nearest, distance);
          if (line.found->verdict == profile::SightVerdict::kHidden && line.found->clearance_m)
            clearest = std::max(clearest, *line.found->clearance_m);
          if (!point.line || point.line->site != site) continue;
          EXPECT_NEAR(point.line->distance_m, line.distance_m, 1e-6);  // the section begins at a point of its own grid
          EXPECT_EQ(point.line->tightest_clearance_m, line.found->clearance_m);
          EXPECT_EQ(point.line->fresnel_fraction.has_value(), line.found->fresnel.has_value());
          if (line.found->fresnel) {
            EXPECT_EQ(*point.line->fresnel_fraction, line.found->fresnel->fraction);
          }
        }
        EXPECT_EQ(point.serving, serving);
        EXPECT_EQ(point.service == PointService::kOutOfReach || point.service == PointService::kNoGround,
                  in_reach == 0);
        if (serving > 0) {
          EXPECT_DOUBLE_EQ(point.line->distance_m, nearest);
        }
        if (point.service == PointService::kHidden && !radio) {
          EXPECT_EQ(*point.line->tightest_clearance_m, clearest);
        }
        EXPECT_EQ(point.service == PointService::kServed, serving >= static_cast<std::size_t>(asked.cover));
        ++(point.service == PointService::kServed ? served : unserved);
      }
      EXPECT_EQ(static_cast<double>(served), made.served());
      EXPECT_GT(served, 0U);
      EXPECT_GT(unserved, 0U);
    }
  }
}

/// A point is served where the budget of itin los for a line from a site gives it enough.
TEST_F(SitePlans, ServeByLevelWhatBudgetsOfSingleLinesServe) {
  for (const NoData rule : {NoData::kClear, NoData::kUnknown}) {
    SitePlanRequest asked = request();
    asked.nodata = rule;
    asked.count = 2;
    asked.frequency_ghz = 5.8;
    asked.link_budget = {.power_dbm = 0, .from_gain_dbi = 10, .to_gain_dbi = 3, .sensitivity_dbm = -85};
    asked.margin_db = 4;
    asked.demand.points.emplace();
    for (int i = 0; i < 120; ++i)
      asked.demand.points->places.push_back({.name = "P" + std::to_string(i),
                                             .position = {300055.0 + i * 37 % 690, 200745.0 - i * 53 % 690},
                                             .height = 1.0 + i % 9});
    const SitePlan made = plan(asked);
    ASSERT_EQ(made.points.size(), 120U);
    profile::LinkQuery query = link_rules(made.request).query;
    query.to_on_surface = asked.demand.on_surface;
    query.budget = asked.link_budget;
    std::size_t served = 0, weak = 0;
    for (const PointResult& point : made.points) {
      SCOPED_TRACE(point.point.name);
      std::size_t serving = 0;
      double greatest = -std::numeric_limits<double>::infinity();
      for (const LinkEnd& end : made.network.ends) {
        if (distance(end.place.position, point.place.position) > asked.radius) continue;
        if (point.service == PointService::kNoGround) continue;
        const profile::Link link = link_between(end.place, point.place);
        const profile::LinkResult line = survey_link(*store_, link, query);
        const auto budget = link_budget_of(link, line, query);
        if (!budget) continue;
        const bool known = line.gap_m == 0 || rule == NoData::kClear;
        if (known && budget->level_dbm >= -81) ++serving;
        if (known || point.serving == 0) greatest = std::max(greatest, budget->level_dbm);
      }
      EXPECT_EQ(point.serving, serving);
      EXPECT_EQ(point.service == PointService::kServed, serving > 0);
      if (point.line && point.line->level_dbm) {
        EXPECT_NEAR(*point.line->level_dbm, greatest, 1e-6);
        EXPECT_NEAR(*point.line->margin_db, greatest + 85, 1e-6);
      }
      served += point.service == PointService::kServed ? 1 : 0;
      weak += point.service == PointService::kTooWeak ? 1 : 0;
    }
    EXPECT_EQ(static_cast<double>(served), made.served());
    EXPECT_GT(served, 0U);
    EXPECT_GT(weak, 0U);
  }
}

/// The cells that sites serve are those of a viewshed in mode kLevel.
TEST_F(SitePlans, ServeByLevelTheCellsOfTheViewshed) {
  SitePlanRequest asked = request();
  asked.nodata = NoData::kClear;
  asked.count = 1;
  asked.frequency_ghz = 5.8;
  asked.link_budget = {.power_dbm = 0, .sensitivity_dbm = -85};
  const SitePlan made = plan(asked);
  Request request;
  for (const LinkEnd& end : made.network.ends)
    request.observers.push_back({end.place.name, end.place.position, end.place.height});
  request.target_height = asked.demand.height;
  request.radius = asked.radius;
  request.grid = made.rasters.grid;
  request.mode = Mode::kLevel;
  request.themes = asked.themes;
  request.nodata = asked.nodata;
  request.earth = asked.earth;
  request.radio = *link_rules(asked).query.radio;
  request.budget = asked.link_budget;
  const Result levels = compute(*store_, request, progress_);
  std::size_t served = 0, unserved = 0;
  for (std::size_t cell = 0; cell < levels.visible.size(); ++cell) {
    if (made.rasters.served[cell] == Verdict::kOutside || levels.visible[cell] == Verdict::kOutside) continue;
    const float level = levels.get<Levels>().level_dbm[cell];
    const Point2 centre = levels.grid.centre(static_cast<std::int64_t>(cell) % levels.grid.columns(),
                                             static_cast<std::int64_t>(cell) / levels.grid.columns());
    const bool own = std::any_of(request.observers.begin(), request.observers.end(),
                                 [&](const Observer& observer) { return observer.position == centre; });
    if (own || std::isnan(level)) continue;
    ASSERT_EQ(made.rasters.served[cell] == Verdict::kVisible, level >= -85) << cell;
    ++(level >= -85 ? served : unserved);
  }
  EXPECT_GT(served, 0U);
  EXPECT_GT(unserved, 0U);
}

/// The server of a cell is the antenna whose single line to it has the greatest level.
TEST_F(SitePlans, NameTheStrongestAntennaOfEachCell) {
  constexpr double kLeast = -78;
  SitePlanRequest asked = request();
  asked.nodata = NoData::kClear;
  asked.count = 2;
  asked.frequency_ghz = 5.8;
  asked.link_budget = {.power_dbm = 0, .sensitivity_dbm = kLeast};
  const auto pattern = std::make_shared<profile::AntennaPattern>(
      profile::AntennaPattern{{{0, 0}, {60, 3}, {180, 25}, {300, 3}}, {{0, 0}, {90, 10}, {180, 20}, {270, 10}}, 15});
  for (SitePlace& place : asked.candidates.places)
    for (const int azimuth : {0, 120, 240})
      place.sectors.push_back({place.name + " at " + std::to_string(azimuth), {pattern, azimuth, 2}});
  const SitePlan made = plan(asked);

  struct Server {
    SitePosition site;
    profile::AimedAntenna antenna;
  };
  std::vector<Server> servers;
  std::vector<std::string> names;
  for (const LinkEnd& end : made.network.ends) {
    if (end.place.sectors.empty()) servers.push_back({end.place, {}}), names.push_back(end.place.name);
    for (const SiteSector& sector : end.place.sectors)
      servers.push_back({end.place, sector.antenna}), names.push_back(sector.name);
  }
  EXPECT_EQ(made.rasters.servers, names);
  EXPECT_EQ(names.size(), 7U);

  profile::LinkQuery query = link_rules(asked).query;
  query.budget = asked.link_budget;
  const RasterGrid& grid = made.rasters.grid;
  const std::vector<float>& levels = made.levels->get<Levels>().level_dbm;
  std::set<std::size_t> named;
  std::size_t unserved = 0;
  for (std::size_t cell = 0; cell < grid.cell_count(); cell += 7) {
    const Point2 centre =
        grid.centre(static_cast<std::int64_t>(cell) % grid.columns(), static_cast<std::int64_t>(cell) / grid.columns());
    std::vector<double> given(servers.size(), -std::numeric_limits<double>::infinity());
    for (std::size_t i = 0; i < servers.size(); ++i) {
      const double metres = distance(servers[i].site.position, centre);
      if (metres > asked.radius || metres == 0) continue;
      profile::Link link = link_between(servers[i].site, {"", centre, asked.demand.height});
      link.budget.from_antenna = servers[i].antenna;
      const auto budget = link_budget_of(link, survey_link(*store_, link, query), query);
      if (budget) given[i] = budget->level_dbm;
    }
    const double greatest = *std::max_element(given.begin(), given.end());
    const std::size_t server = made.rasters.best_server[cell];
    if (made.rasters.served[cell] == Verdict::kOutside || std::isinf(greatest)) continue;
    EXPECT_NEAR(levels[cell], greatest, 1e-3) << cell;
    EXPECT_EQ(server > 0, greatest >= kLeast) << cell;
    unserved += server == 0 ? 1U : 0U;
    if (server == 0 || server > given.size()) continue;
    EXPECT_NEAR(given[server - 1], greatest, 1e-3) << cell;
    named.insert(server);
  }
  EXPECT_GT(named.size(), 3U);
  EXPECT_GT(unserved, 0U);

  const std::vector<PlanFile> written = write_site_plan(file("levels"), made, *store_, progress_);
  EXPECT_EQ(written.size(), 15U);
  for (const PlanFile& one : written) EXPECT_TRUE(std::filesystem::is_regular_file(one.path)) << one.path;
}

/// Pictures in the folder, figures of the report and sheets all come from these maps.
TEST_F(SitePlans, DrawOnEveryMapWhatTheChoiceDependsOn) {
  SitePlanRequest asked = request();
  asked.hub = SitePlace{.position = {300390, 200390}, .height = 70};
  asked.masts = {{.height = 60}};
  asked.forbidden = Window::box({300000, 200080, 300100, 200160});
  const SitePlan made = plan(asked);
  const std::vector<SiteMap> maps = site_maps(*store_, made, progress_);
  ASSERT_EQ(maps.size(), 2U);
  for (const SiteMap& map : maps) {
    std::set<std::string> shown;
    for (const MapObjects& objects : map.sheet.objects)
      for (const profile::SheetKey& key : objects.keys) shown.insert(key.text);
    for (const char* one :
         {"Building outline", "No site here", "Link on a route to the hub", "Chosen site", "Existing site", "Hub"})
      EXPECT_TRUE(shown.contains(one)) << one << " on " << map.name;
    EXPECT_TRUE(map.sheet.area.contains(asked.hub->position));
  }
}

TEST_F(SitePlans, WriteWhatTheyList) {
  SitePlanRequest asked = request();
  asked.hub = SitePlace{.position = {300390, 200390}, .height = 70};
  asked.masts = {{.height = 60}};
  const SitePlan made = plan(asked);
  const std::string folder = file("sites");
  const std::vector<PlanFile> written = write_site_plan(folder, made, *store_, progress_);
  EXPECT_EQ(written.size(), 13U);
  for (const PlanFile& one : written) EXPECT_TRUE(std::filesystem::is_regular_file(one.path)) << one.path;
  std::size_t found = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder)) ++found;
  EXPECT_EQ(found, written.size());
  EXPECT_THROW(write_site_plan(folder, made, *store_, progress_), FileError);
  EXPECT_NO_THROW(write_site_plan(folder, made, *store_, progress_, {.overwrite = true}));
  // Nothing is written where one file would be lost.
  for (const PlanFile& one : written)
    if (!one.path.ends_with("links.csv")) std::filesystem::remove(one.path);
  EXPECT_THROW(write_site_plan(folder, made, *store_, progress_), FileError);
  EXPECT_FALSE(std::filesystem::exists(written.front().path));
  EXPECT_FALSE(std::filesystem::exists(folder + "/coverage.png"));
}

TEST_F(SitePlans, RefuseWhatMakesNoSense) {
  const auto refused = [&](const auto& change) {
    SitePlanRequest asked = request();
    change(asked);
    EXPECT_THROW(plan(asked), InputError);
  };
  refused([](SitePlanRequest& r) { r.candidates = {}; });
  refused([](SitePlanRequest& r) { r.search_area = Window::all(); });
  refused([](SitePlanRequest& r) { r.count.reset(); });
  refused([](SitePlanRequest& r) { r.masts.clear(); });
  refused([](SitePlanRequest& r) { r.radius = 0; });
  refused([](SitePlanRequest& r) { r.share = 2; });
  refused([](SitePlanRequest& r) { r.cover = 0; });
  refused([](SitePlanRequest& r) { r.frequency_ghz = 0; });
  refused([](SitePlanRequest& r) { r.turbines.emplace(); });
  refused([](SitePlanRequest& r) { r.memory_bytes = 1000; });
  refused([](SitePlanRequest& r) {
    r.demand.grid = RasterGrid({300000, 200800}, 20, 20, 10, 10);
    r.demand.weights = {1, 2};
  });
}

}  // namespace
}  // namespace itin::viewshed
