// Which mast serves which building: worked out by hand, against lines of sight by themselves, and against every
// triangle for every place.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <mutex>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include <itin/error.hpp>
#include <itin/tin_heights.hpp>
#include <itin/triangulate.hpp>
#include <profile/links.hpp>
#include <viewshed/premises.hpp>

#include "support/alexandria.hpp"
#include "support/exact_line_of_sight.hpp"
#include "support/houses.hpp"
#include "support/impatient.hpp"
#include "support/raster_file.hpp"
#include "support/seed.hpp"
#include "support/temporary_directory.hpp"
#include "support/told_progress.hpp"
#include "workflows/premises/output/facade_meshes.hpp"
#include "workflows/premises/premises_segments.hpp"

namespace itin::viewshed {
namespace {

class PremisesSurveys : public testing::Test {
 protected:
  /// Ground of 280 m by 280 m at 50 m, with houses on it.
  void build(const std::vector<test::LineFeature>& houses) {
    test::write_raster(directory_.file("t.tif"), {300000, 200280, 10, 29, 29, 27700}, [](int, int) { return 50.0; });
    ImportOptions terrain;
    terrain.sources = {directory_.file("t.tif")};
    import_terrain(store_, terrain, progress_);
    test::import_houses(store_, directory_.file("h.geojson"), houses);
  }

  static SitePlace mast(const std::string& name, double x, double y, double height) {
    return {.name = name, .position = {x, y}, .height = height};
  }

  PremisesSurvey survey(PremisesRequest request) {
    return survey_premises(Store(store_), std::move(request), progress_);
  }

  /// Ground of 1,400 m by 1,400 m with posts 2 m apart, a house in its middle, and eight masts about it.
  PremisesRequest build_plain() {
    test::write_raster(directory_.file("t.tif"), {300000, 201400, 2, 701, 701, 27700},
                       [](int column, int row) { return 50 + 3 * std::sin(0.05 * column) * std::cos(0.03 * row); });
    ImportOptions terrain;
    terrain.sources = {directory_.file("t.tif")};
    import_terrain(store_, terrain, progress_);
    test::import_houses(store_, directory_.file("h.geojson"),
                        {test::box(300690, 200690, 300710, 200705, 9), test::box(300900, 200690, 300912, 200700, 14)});
    PremisesRequest request;
    for (int i = 0; i < 8; ++i) {
      const double turn = 2 * std::numbers::pi * i / 8;
      request.masts.places.push_back(
          mast(std::to_string(i), 300700 + 600 * std::cos(turn), 200700 + 600 * std::sin(turn), 6));
    }
    return request;
  }

  static void expect_same(const PremisesSurvey& one, const PremisesSurvey& other) {
    ASSERT_EQ(other.premises.size(), one.premises.size());
    for (std::size_t i = 0; i < one.premises.size(); ++i) {
      const Premises &a = one.premises[i], &b = other.premises[i];
      EXPECT_EQ(a.best, b.best);
      EXPECT_EQ(a.roof_places, b.roof_places);
      ASSERT_EQ(a.walls.size(), b.walls.size());
      for (std::size_t w = 0; w < a.walls.size(); ++w) {
        EXPECT_EQ(a.walls[w].mast, b.walls[w].mast);
        EXPECT_EQ(a.walls[w].height_m, b.walls[w].height_m);
        EXPECT_EQ(a.walls[w].undecided, b.walls[w].undecided);
      }
      ASSERT_EQ(a.links.size(), b.links.size());
      for (std::size_t k = 0; k < a.links.size(); ++k) expect_same(a.links[k], b.links[k]);
    }
  }

  static void expect_same(const PremisesLink& a, const PremisesLink& b) {
    EXPECT_EQ(a.verdict, b.verdict);
    EXPECT_EQ(a.mast, b.mast);
    ASSERT_EQ(a.blocker.has_value(), b.blocker.has_value());
    if (a.blocker) {
      EXPECT_EQ(a.blocker->feature, b.blocker->feature);
    }
    ASSERT_EQ(a.roof.has_value(), b.roof.has_value());
    if (a.roof) {
      EXPECT_EQ(a.roof->position, b.roof->position);
    }
  }

  static double nearest_to(Point2 p, const std::vector<WallPlace>& walls) {
    double nearest = 1e9;
    for (const WallPlace& wall : walls)
      nearest = std::min(nearest, std::hypot(wall.position.x - p.x, wall.position.y - p.y));
    return nearest;
  }

  /// A link as `itin los` is asked for it.
  struct Asked {
    std::size_t mast = 0;
    Mounting mounting;
    bool served = false;
    const LinkBlocker* blocker = nullptr;
  };

  /// All mountings that the survey tells of, and those just below the least ones.
  static std::vector<Asked> asked_of(const PremisesSurvey& survey) {
    std::vector<Asked> asked;
    const double storey = survey.request.storey;
    for (const Premises& p : survey.premises) {
      for (const PremisesLink& link : p.links) {
        for (const auto& served : {link.wall, link.roof})
          if (served) asked.push_back({link.mast, *served, true});
        if (link.roof && link.roof->height_m > survey.request.poles.front()) {
          Mounting lower = *link.roof;
          lower.height_m = survey.request.poles.front();
          asked.push_back({link.mast, lower, false});
        }
        if (link.tried && link.verdict != Verdict::kUndecided)
          asked.push_back({link.mast, *link.tried, false, link.blocker ? &*link.blocker : nullptr});
      }
      for (const WallPlace& wall : p.walls) {
        if (!wall.mast) continue;
        asked.push_back({*wall.mast, {MountedOn::kWall, wall.position, wall.ground_m, wall.height_m, 0}, true});
        const double lower = wall.height_m - storey;
        if (lower > wall.least_m && std::fmod(wall.height_m, storey) == 0)
          asked.push_back({*wall.mast, {MountedOn::kWall, wall.position, wall.ground_m, lower, 0}, false});
      }
    }
    return asked;
  }

  /// Asks the same of lines of sight by themselves.
  void expect_agreement(const PremisesSurvey& survey) {
    const Store store(store_);
    const std::vector<Asked> asked = asked_of(survey);
    ASSERT_FALSE(asked.empty());
    std::size_t served = 0, zones = 0;
    for (const MountedOn on : {MountedOn::kWall, MountedOn::kRoof}) {
      profile::LinkQuery query;
      query.earth = survey.request.earth, query.themes = survey.request.themes, query.nodata = survey.request.nodata;
      query.to_on_surface = on == MountedOn::kRoof;
      if (survey.request.frequency_ghz)
        query.radio = RadioPath{.frequency_ghz = *survey.request.frequency_ghz,
                                .effective_earth_km = effective_earth_km(query.earth)};
      for (const Asked& a : asked) {
        if (a.mounting.on != on) continue;
        const SitePosition& mast = survey.masts[a.mast];
        const profile::Link link{"", mast.position, mast.height, a.mounting.position, a.mounting.height_m};
        const profile::LinkResult line = profile::survey_link(store, link, query);
        EXPECT_NEAR(line.stands_on.to_m, a.mounting.base_m, 1e-6);
        const bool visible = line.found->verdict == profile::SightVerdict::kVisible;
        const bool clear = visible && (!query.radio || line.found->fresnel->fraction >= survey.request.fresnel);
        EXPECT_EQ(clear, a.served) << mast.name << " to " << a.mounting.position.x << ',' << a.mounting.position.y
                                   << ',' << a.mounting.height_m;
        served += a.served, zones += visible && !clear;
        if (a.blocker != nullptr && !visible) expect_among_obstructions(store, link, query, *a.blocker);
      }
    }
    EXPECT_GT(served, 50U);
    EXPECT_GT(asked.size() - served, 50U);
    if (survey.request.frequency_ghz) {
      EXPECT_GT(zones, 10U);
    }
  }

  static void expect_among_obstructions(const Store& store, const profile::Link& link, const profile::LinkQuery& query,
                                        const LinkBlocker& blocker) {
    profile::LosQuery own = profile::los_query(link, query);
    const profile::LosReport report =
        profile::analyse(store, {.from = link.from, .to = link.to, .themes = query.themes}, own);
    ASSERT_FALSE(report.obstructions.empty());
    const profile::Obstruction& last = report.obstructions.back();
    const double at = std::hypot(blocker.position.x - link.from.x, blocker.position.y - link.from.y);
    EXPECT_NEAR(last.to_m, at, 0.01);
    const bool named = std::any_of(report.obstructions.begin(), report.obstructions.end(), [&](const auto& o) {
      return o.theme == blocker.theme && (blocker.theme == 0 || o.feature == blocker.feature);
    });
    const auto at_exit = [&](const profile::ProfilePoint& p) {
      return std::abs(p.distance_m - at) < 0.2 && p.theme == blocker.theme && p.feature == blocker.feature;
    };
    EXPECT_TRUE(named || std::any_of(report.profile.points.begin(), report.profile.points.end(), at_exit))
        << blocker.name << " at " << blocker.position.x << ',' << blocker.position.y;
  }

  test::TemporaryDirectory directory_;
  const std::string store_ = directory_.file("s.itin");
  NoProgress progress_;
};

TEST_F(PremisesSurveys, OfOneHouseByHand) {
  // 20 m by 10 m, 9.5 m high, with a garage of 2 m before its southern wall; the mast stands 60 m to the west.
  build({test::box(300100, 200100, 300120, 200110, 9.5), test::box(300104, 200094, 300108, 200100, 2)});
  PremisesRequest request;
  request.masts.places = {mast("west", 300040, 200105, 12)};
  request.earth = Earth::flat();
  const PremisesSurvey found = survey(request);
  ASSERT_EQ(found.premises.size(), 2U);
  const Premises& house = found.premises[0];
  ASSERT_EQ(house.walls.size(), 60U);
  std::size_t west = 0;
  for (const WallPlace& wall : house.walls) {
    EXPECT_NEAR(wall.ground_m, 50, 1e-6);
    EXPECT_NEAR(wall.most_m, 9.5, 1e-6);
    const bool before_garage = wall.position.y < 200100 && wall.position.x > 300104 && wall.position.x < 300108;
    EXPECT_NEAR(wall.least_m, before_garage ? 2 : 0, 1e-6);
    if (wall.position.x > 300100) continue;
    ++west;
    EXPECT_NEAR(wall.position.x, 300099.7, 1e-6);
    EXPECT_EQ(wall.mast, 0U);
    EXPECT_EQ(wall.height_m, 3);
  }
  EXPECT_EQ(west, 10U);
  for (const WallPlace& wall : house.walls)
    if (wall.position.x > 300120) {
      EXPECT_FALSE(wall.mast);
    }
  // Of the places on the western wall those in its middle are the nearest to the mast.
  ASSERT_TRUE(house.best);
  EXPECT_EQ(house.best_mounting().on, MountedOn::kWall);
  EXPECT_EQ(house.best_mounting().height_m, 3);
  EXPECT_NEAR(house.best_mounting().distance_m, std::hypot(59.7, 0.5), 1e-6);
  ASSERT_TRUE(house.links.front().roof);
  EXPECT_EQ(house.links.front().roof->height_m, 0);  // the mast's top is higher than the roof
  // The garage has no wall of more than 2.5 m. Its roof is in sight.
  const Premises& garage = found.premises[1];
  EXPECT_TRUE(garage.walls.empty());
  ASSERT_TRUE(garage.best);
  EXPECT_EQ(garage.best_mounting().on, MountedOn::kRoof);
  EXPECT_EQ(found.counts().on_walls, 1U);
  EXPECT_EQ(found.counts().on_roofs, 1U);
}

TEST_F(PremisesSurveys, TellWhatHidesAHouseAndItsLeastPole) {
  // A low house behind a high one, as seen from the mast; both are 10 m long.
  build({test::box(300100, 200100, 300110, 200110, 20), test::box(300130, 200100, 300140, 200110, 6)});
  PremisesRequest request;
  request.masts.places = {mast("west", 300040, 200105, 10)};
  request.poles = {0, 12, 40};
  request.earth = Earth::flat();
  const PremisesSurvey found = survey(request);
  const Premises& low = found.premises[1];
  ASSERT_TRUE(low.best);
  // The line over the high house, 20 m at 69.95 m from the mast, rises 10 m there. At the far edge of the low roof,
  // some 99.5 m away, 6 + 12 m are not enough: 24.2 m are needed.
  EXPECT_EQ(low.best_mounting().on, MountedOn::kRoof);
  EXPECT_EQ(low.best_mounting().height_m, 40);
  EXPECT_TRUE(std::none_of(low.walls.begin(), low.walls.end(), [](const WallPlace& wall) { return wall.mast; }));

  request.poles = {0, 12};
  const PremisesSurvey less = survey(request);
  const Premises& hidden = less.premises[1];
  EXPECT_FALSE(hidden.best);
  EXPECT_EQ(hidden.verdict(), Verdict::kHidden);
  ASSERT_TRUE(hidden.nearest_miss());
  const PremisesLink& miss = *hidden.nearest_miss();
  EXPECT_EQ(miss.tried->height_m, 12);
  ASSERT_TRUE(miss.blocker);
  EXPECT_EQ(miss.blocker->theme, 1);
  EXPECT_EQ(miss.blocker->feature, 0);
  EXPECT_FALSE(miss.blocker->own);
  EXPECT_NEAR(miss.blocker->position.x, 300110, 0.1);
  EXPECT_EQ(less.counts().unserved, 1U);
}

TEST_F(PremisesSurveys, TellTheLeastPolesOfARoofByHand) {
  // 20 m by 10 m, 9.5 m high: its eaves, 0.05 m within its outline, hide a street 5 m before its walls.
  build({test::box(300100, 200100, 300120, 200110, 9.5)});
  PremisesRequest request;
  request.masts.places = {mast("west", 300040, 200105, 12), mast("east", 300180, 200105, 6)};
  request.poles = {0, 4};
  request.setback = 5;
  request.earth = Earth::flat();
  const PremisesSurvey found = survey(request);
  const Premises& house = found.premises.front();
  ASSERT_EQ(house.roof.size(), 200U);
  EXPECT_EQ(house.roof_places, 200U);
  for (const RoofPlace& place : house.roof) {
    EXPECT_NEAR(place.roof_m, 59.5, 1e-6);
    EXPECT_EQ(place.mast, 0U);  // the mast in the west looks down on the roof
    EXPECT_EQ(place.height_m, 0);
    const Point2 p = place.position;
    const double to_wall = std::min({p.x - 300100, 300120 - p.x, p.y - 200100, 200110 - p.y});
    ASSERT_TRUE(place.street);
    EXPECT_NEAR(place.street->street.z, 50, 1e-6);
    EXPECT_NEAR(std::hypot(place.street->street.x - p.x, place.street->street.y - p.y), to_wall + 5, 1e-6);
    EXPECT_NEAR(place.street->pole_m, 9.5 * (to_wall + 5) / 5.05 - 9.5, 1e-3);
    ASSERT_TRUE(place.street->edge);
    EXPECT_EQ(place.street->edge->theme, 1);
    EXPECT_NEAR(place.street->edge->position.z, 59.5, 1e-3);
  }
  request.setback.reset();
  EXPECT_TRUE(survey(request).premises.front().roof.empty());
}

TEST_F(PremisesSurveys, SeeTheStreetFromTheLeastPoleAsLinesOfSightDo) {
  test::import_alexandria(store_);
  PremisesRequest request;
  request.masts.places = {mast("c", 321790, 4297662, 18)};
  request.spacing = 8, request.radius = 150, request.setback = 6;
  const PremisesSurvey found = survey(request);
  const Store store(store_);
  profile::LinkQuery query;
  query.earth = request.earth, query.themes = request.themes, query.to_on_surface = true;
  std::size_t hidden = 0;
  for (const Premises& p : found.premises) {
    for (const RoofPlace& place : p.roof) {
      if (!place.street) continue;
      const auto& [street, pole, edge] = *place.street;
      const auto verdict = [&](double height) {
        const profile::Link link{"", {street.x, street.y}, 0, place.position, height};
        return profile::survey_link(store, link, query).found->verdict;
      };
      EXPECT_EQ(verdict(pole + 1e-3), profile::SightVerdict::kVisible) << place.position.x << ',' << place.position.y;
      if (!edge) continue;
      ++hidden;
      EXPECT_EQ(verdict(std::max(0.0, pole - 1e-2)), profile::SightVerdict::kHidden)
          << place.position.x << ',' << place.position.y;
    }
  }
  EXPECT_GT(hidden, 100U);
}

TEST_F(PremisesSurveys, StandFacadesOnTheGroundFacingOutward) {
  // The ground falls from west to east; a garage of 2 m stands before the southern wall.
  test::write_raster(directory_.file("t.tif"), {300000, 200280, 10, 29, 29, 27700},
                     [](int column, int) { return 50 - 0.2 * column; });
  ImportOptions terrain;
  terrain.sources = {directory_.file("t.tif")};
  import_terrain(store_, terrain, progress_);
  test::import_houses(store_, directory_.file("h.geojson"),
                      {test::box(300100, 200100, 300120, 200110, 9.5), test::box(300104, 200094, 300108, 200100, 2)});
  PremisesRequest request;
  request.masts.places = {mast("west", 300040, 200105, 12)};
  const PremisesSurvey found = survey(request);
  double area = 0;
  const std::vector<ColouredMesh> meshes = facade_meshes(found);
  ASSERT_GE(meshes.size(), 2U);
  EXPECT_EQ(meshes.front().name, "west: served");
  EXPECT_EQ(meshes.back().name, "not served");
  for (const ColouredMesh& mesh : meshes) {
    for (const auto& [a, b, c] : mesh.triangles) {
      const double nx = (b.y - a.y) * (c.z - a.z) - (b.z - a.z) * (c.y - a.y),
                   ny = (b.z - a.z) * (c.x - a.x) - (b.x - a.x) * (c.z - a.z),
                   nz = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x), length = std::hypot(nx, ny, nz);
      area += length / 2;
      EXPECT_NEAR(nz, 0, 1e-9);
      const Point2 out{(a.x + b.x + c.x) / 3 + 0.2 * nx / length, (a.y + b.y + c.y) / 3 + 0.2 * ny / length};
      EXPECT_FALSE(out.x > 300100 && out.x < 300120 && out.y > 200100 && out.y < 200110) << out.x << ',' << out.y;
      const double ground = 50 - 0.02 * (a.x - 300005);
      const bool before_garage = a.y < 200100.01 && a.x > 300103.9 && a.x < 300108.1;
      if (!before_garage) {
        EXPECT_TRUE(std::abs(a.z - ground) < 0.01 || a.z > ground + 8) << a.x << ',' << a.z << " on " << ground;
      }
    }
  }
  // The roof is level with 9.5 m above its lowest or highest corner.
  const double top = found.premises[0].walls[0].ground_m + found.premises[0].walls[0].most_m, mean = 50 - 0.02 * 105;
  EXPECT_NEAR(area, 60 * (top - mean) - 4 * 2, 3);
}

TEST_F(PremisesSurveys, FindNoWallBetweenHousesThatTouch) {
  build({test::box(300100, 200100, 300110, 200110, 8), test::box(300110, 200100, 300120, 200110, 8),
         test::box(300120, 200100, 300130, 200110, 14)});
  PremisesRequest request;
  request.masts.places = {mast("south", 300115, 200050, 30)};
  const PremisesSurvey found = survey(request);
  ASSERT_EQ(found.premises.size(), 3U);
  EXPECT_EQ(found.premises[0].walls.size(), 30U);
  EXPECT_EQ(found.premises[1].walls.size(), 20U);
  EXPECT_EQ(found.premises[2].walls.size(), 40U);  // it is higher than its neighbour by more than 2.5 m
  for (const WallPlace& wall : found.premises[2].walls)
    if (wall.position.x < 300120) {
      EXPECT_NEAR(wall.least_m, 8, 1e-6);
    }
}

TEST_F(PremisesSurveys, AgreeWithLinesOfSightInATown) {
  test::import_alexandria(store_);
  PremisesRequest request;
  request.masts.places = {mast("a", 321590, 4297655, 12), mast("b", 321900, 4297850, 8),
                          mast("c", 321790, 4297662, 18)};
  request.spacing = 4, request.radius = 300;
  expect_agreement(survey(request));
}

TEST_F(PremisesSurveys, AgreeWithLinesOfSightThatNeedAClearZone) {
  test::import_alexandria(store_);
  PremisesRequest request;
  request.masts.places = {mast("a", 321590, 4297655, 12), mast("c", 321790, 4297662, 18)};
  request.spacing = 5, request.radius = 300, request.frequency_ghz = 2.4;
  request.earth = Earth::effective_earth(4.0 / 3);
  expect_agreement(survey(request));
}

TEST_F(PremisesSurveys, AgreeWithEveryTriangleForEveryPlace) {
  std::mt19937_64 random(test::seed());
  const auto in = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
  std::vector<test::LineFeature> houses;
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column)
      houses.push_back(test::turned_box({300050 + column * 55 + in(0, 20), 200050 + row * 55 + in(0, 20)}, in(8, 20),
                                        in(6, 14), in(0, 3), in(2, 16)));
  build(houses);
  PremisesRequest request;
  for (int i = 0; i < 3; ++i)
    request.masts.places.push_back(mast(std::to_string(i), 300020 + 100 * i + in(0, 10), 200020 + in(0, 6), in(5, 25)));
  request.spacing = 3, request.radius = in(100, 250);
  const PremisesSurvey found = survey(request);

  const Tin tin = triangulate(Store(store_), Window::all(), Detail::tolerance(0), progress_, ThemeChoice::all());
  const test::ExactLineOfSight twin(tin, request.earth);
  std::size_t served = 0, unserved = 0;
  for (const Premises& p : found.premises) {
    for (const WallPlace& wall : p.walls) {
      std::optional<std::pair<double, double>> best;  // height, distance
      for (const SitePosition& m : found.masts) {
        const double distance = std::hypot(wall.position.x - m.position.x, wall.position.y - m.position.y);
        if (distance > request.radius) continue;
        std::vector<double> heights;
        for (int k = 1; k * request.storey <= wall.most_m; ++k)
          if (k * request.storey > wall.least_m) heights.push_back(k * request.storey);
        if (heights.empty()) heights.push_back(std::floor(wall.most_m * 100) / 100);
        for (const double height : heights) {
          const double clearance = twin.clearance({m.position.x, m.position.y, m.elevation()},
                                                  {wall.position.x, wall.position.y, wall.ground_m + height});
          if (clearance >= -1e-6 && (!best || std::pair(height, distance) < *best)) best = {height, distance};
        }
      }
      EXPECT_EQ(wall.mast.has_value(), best.has_value()) << wall.position.x << ',' << wall.position.y;
      if (best && wall.mast) {
        EXPECT_EQ(wall.height_m, best->first) << wall.position.x << ',' << wall.position.y;
        EXPECT_NEAR(wall.distance_m, best->second, 1e-9);
      }
      served += best.has_value(), unserved += !best.has_value();
    }
  }
  EXPECT_GT(served, 20U);
  EXPECT_GT(unserved, 20U);
}

TEST_F(PremisesSurveys, DoNotDependOnTheMemory) {
  PremisesRequest request = build_plain();
  std::vector<test::LineFeature> houses;
  for (int i = 0; i < 12; ++i) {
    const double x = 300200 + 90 * i, y = 200250 + 130 * (i % 5);
    houses.push_back(test::box(x, y, x + 14, y + 9, 5 + i % 4));
  }
  test::import_houses(store_, directory_.file("houses.geojson"), houses);
  const PremisesSurvey all = survey(request);
  request.memory_bytes = 1;
  const PremisesSurvey parts = survey(request);
  EXPECT_NE(parts.statistics.triangles, all.statistics.triangles) << "this is no survey in segments";
  expect_same(all, parts);
}

TEST_F(PremisesSurveys, ReadTheGroundOfOneMastAfterTheOtherInLittleMemory) {
  PremisesRequest request = build_plain();
  const PremisesSurvey all = survey(request);
  ASSERT_EQ(all.premises.front().links.size(), 8U);
  request.memory_bytes = 1;
  std::vector<ReachedBuilding> reached{{0, {300689, 200689, 300711, 200706}, {0, 1, 2, 3, 4, 5, 6, 7}}};
  const auto segments = premises_segments(Store(store_), request, all.masts, reached, progress_);
  EXPECT_GE(segments.size(), 3U);
  std::vector<std::size_t> masts;
  for (const PremisesSegment& segment : segments) {
    ASSERT_EQ(segment.buildings.size(), 1U);
    masts.insert(masts.end(), segment.buildings[0].masts.begin(), segment.buildings[0].masts.end());
  }
  EXPECT_EQ(masts, reached.front().masts);
  expect_same(all, survey(request));
}

TEST_F(PremisesSurveys, RefuseMemoryThatDoesNotHoldTheGroundOfOneMast) {
  PremisesRequest request = build_plain();
  test::import_houses(store_, directory_.file("hall.geojson"), {test::box(300300, 200500, 300680, 200900, 12)});
  request.spacing = 8;
  try {
    std::ignore = survey(request);
    request.memory_bytes = 1;
    std::ignore = survey(request);
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_EQ(error.field(), "memory_bytes");
    EXPECT_NE(std::string(error.what()).find("the ground between mast 0 and the building at 300299.69,200499.69 takes"),
              std::string::npos)
        << error.what();
  }
}

TEST_F(PremisesSurveys, TellTheProgressOfTheWholeCall) {
  test::import_alexandria(store_);
  PremisesRequest request;
  request.masts.places = {mast("a", 321590, 4297655, 12), mast("b", 321900, 4297850, 8)};
  request.radius = 200;
  for (const std::uint64_t memory : {std::uint64_t{1} << 30, std::uint64_t{1}}) {
    request.memory_bytes = memory;
    test::ToldProgress told;
    std::ignore = survey_premises(Store(store_), request, told);
    told.expect_whole_call();
    told.expect_steps_up_to(0.7);
  }
}

/// Keeps the longest time between two looks at whether the call is cancelled.
class Watchful final : public Progress {
 public:
  void report(std::string_view, double) override {}
  bool cancelled() const override {
    const std::lock_guard lock(mutex_);
    const auto now = Clock::now();
    longest_ = std::max(longest_, now - last_);
    last_ = now;
    return false;
  }
  double longest_seconds() const { return std::chrono::duration<double>(longest_).count(); }

 private:
  using Clock = std::chrono::steady_clock;
  mutable std::mutex mutex_;
  mutable Clock::time_point last_ = Clock::now();
  mutable Clock::duration longest_{};
};

TEST_F(PremisesSurveys, AreCancelledWithinASecondEvenInOneHall) {
  build({test::box(300020, 200020, 300260, 200260, 12)});
  PremisesRequest request;
  request.masts.places = {mast("a", 300010, 200010, 20), mast("b", 300270, 200010, 16), mast("c", 300270, 200270, 14)};
  request.spacing = 0.5, request.frequency_ghz = 26, request.earth = Earth::effective_earth(4.0 / 3);
  Watchful watchful;
  const auto begin = std::chrono::steady_clock::now();
  std::ignore = survey_premises(Store(store_), request, watchful);
  const double whole = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  EXPECT_LT(watchful.longest_seconds(), std::max(0.5, whole / 5)) << "of " << whole << " s";

  request.spacing = 5;
  test::Impatient patient(1 << 30);
  std::ignore = survey_premises(Store(store_), request, patient);
  for (const int looks : {0, 10, patient.asked() / 2, patient.asked() - 1}) {
    test::Impatient impatient(looks);
    EXPECT_THROW(std::ignore = survey_premises(Store(store_), request, impatient), Cancelled) << looks;
  }
}

TEST_F(PremisesSurveys, LeaveOpenWhatGroundWithoutDataMayHide) {
  // A strip without data between the mast and the house.
  test::write_raster(directory_.file("t.tif"), {300000, 200280, 10, 29, 29, 27700},
                     [](int column, int) { return column >= 8 && column <= 12 ? std::nan("") : 50.0; });
  ImportOptions terrain;
  terrain.sources = {directory_.file("t.tif")};
  import_terrain(store_, terrain, progress_);
  test::import_houses(store_, directory_.file("h.geojson"), {test::box(300180, 200100, 300200, 200110, 9)});
  PremisesRequest request;
  request.masts.places = {mast("west", 300040, 200105, 20)};
  const PremisesSurvey unknown = survey(request);
  EXPECT_EQ(unknown.counts().undecided, 1U);
  EXPECT_EQ(unknown.premises.front().nearest_miss()->verdict, Verdict::kUndecided);
  EXPECT_TRUE(std::any_of(unknown.premises.front().walls.begin(), unknown.premises.front().walls.end(),
                          [](const WallPlace& wall) { return wall.undecided; }));
  request.nodata = NoData::kBlock;
  EXPECT_EQ(survey(request).counts().unserved, 1U);
  request.nodata = NoData::kClear;
  EXPECT_EQ(survey(request).counts().on_walls, 1U);
}

TEST_F(PremisesSurveys, RefuseWhatMakesNoSense) {
  build({test::box(300100, 200100, 300120, 200110, 9)});
  PremisesRequest request;
  const auto expect_refused = [&](const char* text) {
    try {
      survey(request);
      ADD_FAILURE() << text;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(text), std::string::npos) << error.what();
    }
  };
  expect_refused("`masts`: there is none");
  request.masts.places = {mast("in", 300110, 200105, 5)};
  expect_refused("mast in at 300110,200105: it ends 4.00 m below");
  request.masts.places = {mast("off", 310000, 200105, 5)};
  expect_refused("mast off at 310000,200105: there is no data there");
  request.masts.places = {mast("far", 300020, 200020, 5)};
  request.radius = 50;
  expect_refused("no building is within the `radius` of 50 m of a mast; the nearest is 113 m away");
  request.radius = 500, request.themes = ThemeChoice::none();
  expect_refused("`themes`: none of them has buildings");
  request.themes = ThemeChoice::all(), request.spacing = 0;
  expect_refused("`spacing`");
  request.spacing = 1, request.setback = 0;
  expect_refused("`setback`: give more than 0 m");
  request.setback.reset(), request.frequency_ghz = 5, request.poles = {0};
  expect_refused("`poles`: with a `frequency_ghz` give a height above 0");
}

}  // namespace
}  // namespace itin::viewshed
