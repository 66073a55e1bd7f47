// Which mast serves which building: worked out by hand, against lines of sight by themselves, and against every
// triangle for every place.
#include <algorithm>
#include <cmath>
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
#include "support/raster_file.hpp"
#include "support/seed.hpp"
#include "support/temporary_directory.hpp"

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
  test::import_alexandria(store_);
  PremisesRequest request;
  request.masts.places = {mast("a", 321590, 4297655, 12), mast("b", 321900, 4297850, 8),
                          mast("c", 321790, 4297662, 18)};
  request.spacing = 3, request.radius = 120;
  const PremisesSurvey all = survey(request);
  request.memory_bytes = 1;
  const PremisesSurvey parts = survey(request);
  EXPECT_NE(parts.statistics.triangles, all.statistics.triangles) << "this is no survey in segments";
  ASSERT_EQ(parts.premises.size(), all.premises.size());
  for (std::size_t i = 0; i < all.premises.size(); ++i) {
    const Premises &a = all.premises[i], &b = parts.premises[i];
    EXPECT_EQ(a.best, b.best);
    ASSERT_EQ(a.walls.size(), b.walls.size());
    for (std::size_t w = 0; w < a.walls.size(); ++w) {
      EXPECT_EQ(a.walls[w].mast, b.walls[w].mast);
      EXPECT_EQ(a.walls[w].height_m, b.walls[w].height_m);
    }
    ASSERT_EQ(a.links.size(), b.links.size());
    for (std::size_t k = 0; k < a.links.size(); ++k) {
      const PremisesLink &of_a = a.links[k], &of_b = b.links[k];
      EXPECT_EQ(of_a.verdict, of_b.verdict);
      EXPECT_EQ(of_a.mast, of_b.mast);
      ASSERT_EQ(of_a.blocker.has_value(), of_b.blocker.has_value());
      if (of_a.blocker) {
        EXPECT_EQ(of_a.blocker->feature, of_b.blocker->feature);
      }
      if (of_a.roof) {
        EXPECT_EQ(of_a.roof->position, of_b.roof->position);
      }
    }
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
  request.spacing = 1, request.frequency_ghz = 5, request.poles = {0};
  expect_refused("`poles`: with a `frequency_ghz` give a height above 0");
}

}  // namespace
}  // namespace itin::viewshed
