// What dwellings see of turbines, and their shadow flicker: known answers, symmetry, and every line and every minute
// against twins that share nothing.
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include <itin/coordinates.hpp>
#include <itin/degrees.hpp>
#include <itin/error.hpp>
#include <itin/geodesic.hpp>
#include <itin/triangulate.hpp>
#include <viewshed/dwellings.hpp>

#include "support/alexandria.hpp"
#include "support/exact_line_of_sight.hpp"
#include "support/houses.hpp"
#include "support/impatient.hpp"
#include "support/raster_file.hpp"
#include "support/seed.hpp"
#include "support/temporary_directory.hpp"
#include "turbines/sun_behind_rotor.hpp"
#include "workflows/dwellings/dwelling_facades.hpp"

namespace itin::viewshed {
namespace {

constexpr std::uint32_t kDay = 1440;

/// The day of the year, from 0.
std::uint32_t day_number(int year, unsigned month, unsigned day) {
  using namespace std::chrono;
  return static_cast<std::uint32_t>(
      (sys_days{std::chrono::year{year} / month / day} - sys_days{std::chrono::year{year} / 1 / 1}).count());
}

/// A hub at this horizontal distance, grid azimuth and elevation.
Point3 hub_at(double distance, double azimuth_deg, double elevation_deg) {
  const double a = in_radians(azimuth_deg);
  return {distance * std::sin(a), distance * std::cos(a), distance * std::tan(in_radians(elevation_deg))};
}

class SunBehindRotors : public testing::Test {
 protected:
  static const SunYear& year() {
    static const SunYear of_2026({2026, 0}, NoProgress());
    return of_2026;
  }
  static std::size_t minutes(Point2 lon_lat, const SeenRotor& rotor, double convergence = 0) {
    return sun_behind(year(), {SkyAt(lon_lat, 0), convergence}, rotor, 3).size();
  }
};

// On the equator at the equinox the sun rises upright in the east, by a degree in four minutes.
TEST_F(SunBehindRotors, TakesSoLongOnTheEquatorAtTheEquinox) {
  const double morning_of_equinox = -101.5;  // the equinox of 2026 is on March 20, 14:46
  const auto found = sun_behind(year(), {SkyAt({morning_of_equinox, 0}, 0)}, {hub_at(500, 90, 30), 50}, 3);
  const auto on_equinox = std::count_if(found.begin(), found.end(),
                                        [](const SunMinute& m) { return m.minute / kDay == day_number(2026, 3, 20); });
  const double closed_form = 2 * in_degrees(std::asin(50 * std::cos(in_radians(30)) / 500)) * 4;
  EXPECT_NEAR(closed_form, 39.75, 0.01);
  EXPECT_NEAR(static_cast<double>(on_equinox), closed_form, 1);
}

TEST_F(SunBehindRotors, IsTheSameInTheEastAndInTheWest) {
  for (const double latitude : {0.0, 35.0, 55.0}) {
    for (const double from_south : {40.0, 75.0, 95.0}) {
      const auto east = static_cast<double>(minutes({0, latitude}, {hub_at(700, 180 - from_south, 12), 60}));
      const auto west = static_cast<double>(minutes({0, latitude}, {hub_at(700, 180 + from_south, 12), 60}));
      // The year is no whole number of days, and the sun's way in the morning is not quite that in the evening.
      EXPECT_NEAR(east, west, 5 + 0.02 * east) << latitude << ", " << from_south;
    }
  }
}

TEST_F(SunBehindRotors, LookedAtFromTheNorthIsNever) {
  EXPECT_EQ(minutes({0, 52}, {hub_at(700, 0, 8), 60}), 0U);
  EXPECT_GT(minutes({0, -35}, {hub_at(700, 0, 35), 60}), 100U);
}

TEST_F(SunBehindRotors, GrowsWithTheRotorAndShrinksWithTheElevationAsked) {
  const SunEye eye{SkyAt({10, 50}, 0)};
  std::size_t before = 0;
  for (const double radius : {20.0, 40.0, 60.0, 90.0}) {
    const std::size_t now = sun_behind(year(), eye, {hub_at(600, 120, 10), radius}, 3).size();
    EXPECT_GT(now, before);
    before = now;
  }
  for (const double least : {5.0, 8.0, 12.0}) {
    const std::size_t now = sun_behind(year(), eye, {hub_at(600, 120, 10), 90}, least).size();
    EXPECT_LT(now, before);
    before = now;
  }
}

TEST_F(SunBehindRotors, MindsWhereTheGridsNorthLies) {
  const auto turned = sun_behind(year(), {SkyAt({10, 50}, 0), in_radians(7)}, {hub_at(600, 113, 10), 60}, 3);
  const auto straight = sun_behind(year(), {SkyAt({10, 50}, 0)}, {hub_at(600, 120, 10), 60}, 3);
  ASSERT_GT(straight.size(), 100U);
  ASSERT_EQ(turned.size(), straight.size());
  for (std::size_t i = 0; i < turned.size(); ++i) EXPECT_EQ(turned[i].minute, straight[i].minute);
}

TEST_F(SunBehindRotors, IsSeenFromAFacadeWhereItIsBeforeIt) {
  SunEye eye{SkyAt({10, 50}, 0), in_radians(3)};
  const SeenRotor rotor{hub_at(150, 120, 10), 60};
  const auto open = sun_behind(year(), eye, rotor, 3);
  bool some = false, none = false;
  for (double outward = 0; outward < 360; outward += 9) {
    eye.outward_deg = outward;
    const double a = in_radians(outward);
    std::vector<std::uint32_t> before, told;
    for (const SunMinute& m : open)
      if (m.direction.x * std::sin(a) + m.direction.y * std::cos(a) > 0) before.push_back(m.minute);
    for (const SunMinute& m : sun_behind(year(), eye, rotor, 3)) told.push_back(m.minute);
    EXPECT_EQ(told, before) << outward;
    some = some || (!told.empty() && told.size() < open.size()), none = none || told.empty();
  }
  EXPECT_TRUE(some && none);
}

/// The sun by the series of the Astronomical Almanac (page C24) and the formulas of spherical triangles, lifted by the
/// refraction of Bennett: where it stands from true east, true north and up.
struct AlmanacSun {
  AlmanacSun(double julian, double lon, double lat) {
    const double n = julian - 2451545.0, g = in_radians(357.528 + 0.9856003 * n);
    const double longitude = in_radians(280.460 + 0.9856474 * n + 1.915 * std::sin(g) + 0.020 * std::sin(2 * g));
    const double tilt = in_radians(23.439 - 0.0000004 * n);
    const double ascension = std::atan2(std::cos(tilt) * std::sin(longitude), std::cos(longitude));
    const double declination = std::asin(std::sin(tilt) * std::sin(longitude));
    const double hour = in_radians(15 * std::fmod(18.697374558 + 24.06570982441908 * n, 24) + lon) - ascension;
    const double phi = in_radians(lat);
    const double sine = std::sin(phi) * std::sin(declination) + std::cos(phi) * std::cos(declination) * std::cos(hour);
    azimuth =
        std::atan2(-std::cos(declination) * std::sin(hour),
                   std::cos(phi) * std::sin(declination) - std::sin(phi) * std::cos(declination) * std::cos(hour));
    // Bennett gives the refraction by the apparent elevation.
    const double truly = in_degrees(std::asin(sine));
    elevation_deg = truly;
    for (int i = 0; i < 6 && truly > -1; ++i)
      elevation_deg = truly + 1 / std::tan(in_radians(elevation_deg + 7.31 / (elevation_deg + 4.4))) / 60;
  }
  double azimuth, elevation_deg;
};

TEST_F(SunBehindRotors, AgreesWithTheAlmanacInEveryMinute) {
  std::mt19937 random(test::seed());
  const auto in = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
  for (int i = 0; i < 2; ++i) {
    const double lon = in(-180, 180), lat = in(-65, 65), distance = in(150, 1500), radius = in(20, 90);
    const Point3 hub = hub_at(distance, in(0, 360), in(0, 40));
    std::set<std::uint32_t> found;
    for (const SunMinute& m : sun_behind(year(), {SkyAt({lon, lat}, 0)}, {hub, radius}, 3))
      EXPECT_TRUE(found.insert(m.minute).second) << "told twice";
    for (std::uint32_t minute = 0; minute < 365 * kDay; ++minute) {
      const AlmanacSun sun(2461041.5 + (minute + 0.5) / kDay, lon, lat);
      const double e = in_radians(sun.elevation_deg);
      const Point3 u{std::cos(e) * std::sin(sun.azimuth), std::cos(e) * std::cos(sun.azimuth), std::sin(e)};
      const Point3 across{hub.y * u.z - hub.z * u.y, hub.z * u.x - hub.x * u.z, hub.x * u.y - hub.y * u.x};
      const double off = std::hypot(across.x, across.y, across.z);
      const bool before = hub.x * u.x + hub.y * u.y + hub.z * u.z > 0;
      const double slack = in_radians(0.05) * std::hypot(hub.x, hub.y, hub.z);
      const bool surely = before && off < radius - slack && sun.elevation_deg > 3.05;
      const bool perhaps = before && off < radius + slack && sun.elevation_deg > 2.95;
      const bool told = found.contains(minute);
      EXPECT_TRUE(told ? perhaps : !surely) << lon << ',' << lat << ' ' << minute;
    }
  }
}

class DwellingSurveys : public testing::Test {
 protected:
  /// Ground of 3,000 m by 1,000 m with posts `step` m apart, west to east, in the British grid.
  void build(const std::function<double(double east)>& height, const std::vector<test::LineFeature>& houses = {},
             double step = 20) {
    const int columns = static_cast<int>(3000 / step) + 1, rows = static_cast<int>(1000 / step) + 1;
    test::write_raster(directory_.file("t.tif"), {400000, 201000, step, columns, rows, 27700},
                       [&](int column, int) { return height(step * column); });
    ImportOptions terrain;
    terrain.sources = {directory_.file("t.tif")};
    import_terrain(store_, terrain, progress_);
    if (!houses.empty()) test::import_houses(store_, directory_.file("h.geojson"), houses);
  }

  static Turbine turbine(double x, double y, std::size_t number = 1) {
    return {.number = number, .position = {x, y}, .tip_height = 140, .hub_height = 90, .rotor_diameter = 100};
  }

  /// A place in the open and a turbine 600 m to its east, a little south.
  static DwellingsRequest open_place() {
    DwellingsRequest request;
    request.turbines.turbines = {turbine(401100, 200400)};
    request.dwellings.places = {{.name = "cottage", .position = {400500, 200500}}};
    request.flicker.year = {2027, 0};
    return request;
  }

  DwellingsSurvey survey(DwellingsRequest request) {
    return survey_dwellings(Store(store_), std::move(request), progress_);
  }

  /// Where the sun goes over a dwelling in the British grid.
  static SunEye sun_eye(const Dwelling& dwelling, const DwellingFacade& facade) {
    const CoordinateTransform to_geographic("EPSG:27700", "EPSG:4326");
    const Point2 here = to_geographic(dwelling.position),
                 north = to_geographic({dwelling.position.x, dwelling.position.y + 100});
    return {SkyAt(here, dwelling.facades.front().ground_m), in_radians(geodesic(here, north).azimuth_deg),
            facade.outward_deg};
  }

  std::uint32_t minutes_of(const DwellingsSurvey& survey, std::size_t dwelling = 0) {
    return flicker_sum(survey, survey.dwellings[dwelling]).minutes;
  }

  static void expect_same(const DwellingsSurvey& one, const DwellingsSurvey& other) {
    ASSERT_EQ(one.dwellings.size(), other.dwellings.size());
    for (std::size_t i = 0; i < one.dwellings.size(); ++i) {
      const auto &a = one.dwellings[i].facades, &b = other.dwellings[i].facades;
      ASSERT_EQ(a.size(), b.size());
      for (std::size_t f = 0; f < a.size(); ++f) {
        EXPECT_EQ(a[f].position, b[f].position);
        ASSERT_EQ(a[f].flicker.size(), b[f].flicker.size());
        for (std::size_t k = 0; k < a[f].flicker.size(); ++k) {
          EXPECT_EQ(a[f].flicker[k].turbine, b[f].flicker[k].turbine);
          EXPECT_EQ(a[f].flicker[k].runs, b[f].flicker[k].runs);
        }
        ASSERT_EQ(a[f].screened.size(), b[f].screened.size());
        for (std::size_t t = 0; t < a[f].screened.size(); ++t) {
          EXPECT_EQ(a[f].screened[t].tip, b[f].screened[t].tip);
          EXPECT_EQ(a[f].screened[t].hub, b[f].screened[t].hub);
          EXPECT_EQ(a[f].screened[t].visible, b[f].screened[t].visible);
          EXPECT_EQ(a[f].bare[t].tip, b[f].bare[t].tip);
          EXPECT_EQ(a[f].bare[t].visible, b[f].bare[t].visible);
        }
      }
    }
  }

  void expect_refused(DwellingsRequest request, const std::string& field, const std::string& message) {
    try {
      survey(std::move(request));
      FAIL() << "not refused: " << message;
    } catch (const InputError& error) {
      EXPECT_EQ(error.field(), field);
      EXPECT_NE(std::string(error.what()).find(message), std::string::npos) << error.what();
    }
  }

  test::TemporaryDirectory directory_;
  const std::string store_ = directory_.file("s.itin");
  NoProgress progress_;
};

TEST_F(DwellingSurveys, CountWhatTheSunAloneTellsOnAPlain) {
  build([](double) { return 50; });
  const DwellingsSurvey found = survey(open_place());
  ASSERT_EQ(found.dwellings.size(), 1U);
  EXPECT_EQ(found.dwellings[0].nearest, 0U);
  EXPECT_NEAR(found.dwellings[0].nearest_m, std::hypot(600, 100), 1e-9);
  const SunYear year({2027, 0}, progress_);
  const double drop = Earth().drop(std::hypot(600, 100));
  const auto alone =
      sun_behind(year, sun_eye(found.dwellings[0], found.dwellings[0].facades[0]), {{600, -100, 88 - drop}, 50}, 3);
  ASSERT_GT(alone.size(), 300U);
  EXPECT_EQ(minutes_of(found), alone.size());
}

TEST_F(DwellingSurveys, AHouseBeforeTheEyeHidesTheSun) {
  build([](double) { return 50; }, {test::box(400520, 200400, 400540, 200600, 60)});
  EXPECT_EQ(minutes_of(survey(open_place())), 0U);
  DwellingsRequest bare = open_place();
  bare.themes = ThemeChoice::none();
  EXPECT_GT(minutes_of(survey(bare)), 300U);
}

TEST_F(DwellingSurveys, AHillBehindTheTurbineHidesTheSun) {
  // From 1,400 m east of the eye the ground rises to 150 m above it: 6.1 degrees.
  build([](double east) { return east < 1900 ? 50.0 : 200.0; });
  const DwellingsSurvey found = survey(open_place());
  const std::uint32_t behind_hill = minutes_of(found);
  DwellingsRequest high = open_place();
  high.flicker.least_elevation_deg = 6.3;
  const std::uint32_t above = minutes_of(survey(high));
  EXPECT_GT(behind_hill, 0U);
  EXPECT_NEAR(behind_hill, above, 0.2 * above);
  EXPECT_GE(behind_hill, above);
}

TEST_F(DwellingSurveys, AgreeWithEveryTriangleInEveryMinute) {
  std::mt19937_64 random(test::seed());
  const auto in = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
  std::vector<test::LineFeature> houses;
  for (int i = 0; i < 8; ++i)
    houses.push_back(test::turned_box({400420 + 90.0 * i + in(0, 20), 200450 + in(-80, 80)}, in(10, 25), in(8, 14),
                                      in(0, 3), in(4, 25)));
  build([&](double east) { return 50 + 12 * std::sin(east / 90) + 60 * std::max(0.0, east / 3000 - 0.5); }, houses, 50);
  DwellingsRequest request = open_place();
  request.turbines.turbines.push_back(turbine(401000, 200250, 2));
  request.dwellings.places.clear();
  const DwellingsSurvey found = survey(request);
  const Tin tin = triangulate(Store(store_), Window::all(), Detail::tolerance(0), progress_, ThemeChoice::all());
  const test::ExactLineOfSight twin(tin, request.earth);
  const SunYear year(request.flicker.year, progress_);
  std::size_t lit = 0, hidden = 0, looked = 0;
  for (const Dwelling& house : found.dwellings) {
    for (const DwellingFacade& facade : house.facades) {
      for (std::size_t t = 0; t < 2; ++t) {
        const Turbine& turbine = found.request.turbines.turbines[t];
        const Point3 eye{facade.position.x, facade.position.y, facade.ground_m + 2};
        const double distance = std::hypot(turbine.position.x - eye.x, turbine.position.y - eye.y);
        const SunEye sun = sun_eye(house, facade);
        const SeenRotor rotor{{turbine.position.x - eye.x, turbine.position.y - eye.y,
                               found.ground_m[t] + 90 - request.earth.drop(distance) - eye.z},
                              50};
        std::set<std::uint32_t> told;
        for (const FlickerRun& run : flicker_runs({.facades = {facade}}, t))
          for (std::uint32_t m = run.first; m < run.first + run.minutes; ++m) told.insert(m);
        for (const SunMinute& m : sun_behind(year, sun, rotor, 3)) {
          if (++looked % 29 != 0) continue;
          const double level = std::hypot(m.direction.x, m.direction.y), far = 4000;
          const double clear =
              twin.clearance(eye, {eye.x + far * m.direction.x / level, eye.y + far * m.direction.y / level,
                                   eye.z + far * m.direction.z / level + request.earth.drop(far)});
          if (std::abs(clear) < 1e-3) continue;  // it grazes
          EXPECT_EQ(told.contains(m.minute), clear > 0) << m.minute << " at " << eye.x << ',' << eye.y << ": " << clear;
          ++(clear > 0 ? lit : hidden);
        }
      }
    }
  }
  EXPECT_GT(lit, 20U);
  EXPECT_GT(hidden, 20U);
}

TEST_F(DwellingSurveys, SeeATurbineOnAPlainAsBigAsItIs) {
  build([](double) { return 50; });
  DwellingsRequest request = open_place();
  request.earth = Earth::flat();
  const DwellingsSurvey found = survey(request);
  const double distance = std::hypot(600, 100);
  EXPECT_TRUE(found.dwellings[0].facades[0].screened.empty());
  EXPECT_FALSE(view_of(found, found.dwellings[0], SightSurface::kScreened));
  const auto view = view_of(found, found.dwellings[0], SightSurface::kBare);
  ASSERT_TRUE(view && view->arc);
  EXPECT_EQ(view->tips, 1U);
  EXPECT_EQ(view->hubs, 1U);
  EXPECT_EQ(view->nearest_seen, 0U);
  EXPECT_NEAR(view->arc->width, 2 * in_degrees(std::atan(50 / distance)), 1e-9);
  EXPECT_NEAR(view->arc->from + view->arc->width / 2, 90 + in_degrees(std::atan2(100, 600)), 1e-9);
  EXPECT_NEAR(view->vertical_deg, in_degrees(std::atan(138 / distance) + std::atan(2 / distance)), 1e-3);
}

TEST_F(DwellingSurveys, SeeNothingBehindAFacadeNorPastATallHouse) {
  build([](double) { return 50; },
        {test::box(400500, 200500, 400520, 200512, 6), test::box(400560, 200300, 400580, 200700, 80)});
  DwellingsRequest request = open_place();
  request.dwellings.places[0].position = {400510, 200506};
  const DwellingsSurvey found = survey(request);
  for (const DwellingFacade& facade : found.dwellings[0].facades) {
    const bool looks_at_it = facade.bare[0].tip != Verdict::kOutside;
    // The turbine is in the east, a little south: before the eastern and the southern facade.
    EXPECT_EQ(looks_at_it, *facade.outward_deg > 45 && *facade.outward_deg < 225);
    EXPECT_EQ(view_of(found, facade, SightSurface::kBare).has_value(), looks_at_it);
    EXPECT_EQ(facade.screened[0].tip, looks_at_it ? Verdict::kHidden : Verdict::kOutside);
    if (looks_at_it) {
      EXPECT_EQ(facade.bare[0].tip, Verdict::kVisible);
      EXPECT_EQ(facade.bare[0].hub, Verdict::kVisible);
    }
  }
  EXPECT_EQ(view_of(found, found.dwellings[0], SightSurface::kBare)->tips, 1U);
  EXPECT_EQ(view_of(found, found.dwellings[0], SightSurface::kScreened)->tips, 0U);
}

TEST_F(DwellingSurveys, SeeWhatEveryTriangleLeavesToSee) {
  std::mt19937_64 random(test::seed());
  const auto in = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
  std::vector<test::LineFeature> houses;
  for (int i = 0; i < 14; ++i)
    houses.push_back(test::turned_box({400420 + 45.0 * i + in(0, 10), 200450 + in(-80, 80)}, in(10, 20), in(8, 14),
                                      in(0, 3), in(4, 60)));
  build([](double east) { return 50 + 25 * std::sin(east / 90); }, houses, 50);
  DwellingsRequest request = open_place();
  request.turbines.turbines.push_back(turbine(402400, 200250, 2));
  request.dwellings.places.clear();
  const DwellingsSurvey found = survey(request);
  const Store store(store_);
  const auto tin_of = [&](const ThemeChoice& themes) {
    return triangulate(store, Window::all(), Detail::tolerance(0), progress_, themes);
  };
  const Tin ground = tin_of(ThemeChoice::none()), surface = tin_of(ThemeChoice::all());
  const test::ExactLineOfSight bare(ground, request.earth), screened(surface, request.earth);
  std::size_t seen = 0, hidden = 0, partly = 0;
  for (const Dwelling& house : found.dwellings) {
    for (const DwellingFacade& facade : house.facades) {
      const Point3 eye{facade.position.x, facade.position.y, facade.ground_m + 2};
      for (std::size_t t = 0; t < 2; ++t) {
        const Turbine& turbine = found.request.turbines.turbines[t];
        const auto expect = [&](const test::ExactLineOfSight& twin, const TurbineSight& sight) {
          if (sight.tip == Verdict::kOutside) return;
          const auto clear = [&](double height) {
            return twin.clearance(eye, {turbine.position.x, turbine.position.y, found.ground_m[t] + height}) >= -1e-6;
          };
          EXPECT_EQ(sight.tip == Verdict::kVisible, clear(140));
          EXPECT_EQ(sight.hub == Verdict::kVisible, clear(90));
          ++(sight.tip == Verdict::kVisible ? seen : hidden);
          if (sight.tip != Verdict::kVisible) return;
          const double least = 140 - sight.visible;
          EXPECT_TRUE(clear(least + 0.01)) << least;
          if (least > 0.01) {
            EXPECT_FALSE(clear(least - 0.01)) << least;
            ++partly;
          }
        };
        expect(bare, facade.bare[t]), expect(screened, facade.screened[t]);
        if (facade.screened[t].tip == Verdict::kVisible) {
          EXPECT_EQ(facade.bare[t].tip, Verdict::kVisible) << "houses cannot uncover";
          EXPECT_LE(facade.screened[t].visible, facade.bare[t].visible + 1e-9);
        }
      }
    }
  }
  EXPECT_GT(seen, 20U);
  EXPECT_GT(hidden, 10U);
  EXPECT_GT(partly, 10U);
}

TEST_F(DwellingSurveys, FindTheFacadesOfAHouse) {
  build([](double) { return 50; }, {test::box(400500, 200500, 400520, 200512, 6)});
  DwellingsRequest request = open_place();
  request.dwellings.places[0].position = {400510, 200506};
  const DwellingsSurvey found = survey(request);
  ASSERT_EQ(found.dwellings.size(), 1U);
  EXPECT_EQ(found.dwellings[0].name, "cottage");
  EXPECT_EQ(found.dwellings[0].feature, 0);
  std::vector<DwellingFacade> facades = found.dwellings[0].facades;
  std::sort(facades.begin(), facades.end(),
            [](const auto& a, const auto& b) { return *a.outward_deg < *b.outward_deg; });
  ASSERT_EQ(facades.size(), 4U);
  const double lengths[] = {20, 12, 20, 12};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(*facades[i].outward_deg, 90.0 * static_cast<double>(i), 1e-6);
    EXPECT_NEAR(facades[i].length_m, lengths[i], 1.01);
    EXPECT_NEAR(facades[i].ground_m, 50, 0.02);
  }
  EXPECT_NEAR(facades[1].position.x, 400520.3, 0.11);
  EXPECT_NEAR(facades[1].position.y, 200506, 1);
  // The turbine is in the east: its shadow falls on the eastern facade, and never on the western.
  EXPECT_FALSE(facades[1].flicker.empty());
  EXPECT_TRUE(facades[3].flicker.empty());
}

TEST_F(DwellingSurveys, CountAMinuteOnceHoweverManyShadowsFall) {
  Dwelling house;
  house.facades = {{.flicker = {{0, {{100, 20}, {kDay + 10, 5}}}, {1, {{110, 30}}}}},
                   {.flicker = {{1, {{135, 10}, {2 * kDay - 5, 5}}}}}};
  EXPECT_EQ(flicker_runs(house), (std::vector<FlickerRun>{{100, 45}, {kDay + 10, 5}, {2 * kDay - 5, 5}}));
  EXPECT_EQ(flicker_runs(house, 1), (std::vector<FlickerRun>{{110, 35}, {2 * kDay - 5, 5}}));
  DwellingsSurvey of_one;
  of_one.dwellings = {house};
  FlickerRules& rules = of_one.request.flicker;
  rules.limit_minutes_day = 44, rules.limit_minutes_year = 55, rules.months.emplace();
  (*rules.months)[0] = {0.25, 0.5};
  const FlickerSum sum = flicker_sum(of_one, house);
  EXPECT_EQ(sum.minutes, 55U);
  EXPECT_EQ(sum.days, 2U);
  EXPECT_EQ(sum.worst_day, 0U);
  EXPECT_EQ(sum.worst_minutes, 45U);
  EXPECT_TRUE(sum.over_day);
  EXPECT_FALSE(sum.over_year);
  EXPECT_DOUBLE_EQ(*sum.likely, 55 * 0.125);
}

TEST_F(DwellingSurveys, RunsEndWithTheDay) {
  Dwelling house;
  house.facades = {{.flicker = {{0, {{kDay - 5, 5}, {kDay, 5}}}}}};
  EXPECT_EQ(flicker_runs(house), (std::vector<FlickerRun>{{kDay - 5, 5}, {kDay, 5}}));
}

TEST_F(DwellingSurveys, TellTheSameMomentsByEveryClock) {
  build([](double) { return 50; });
  DwellingsRequest ahead = open_place();
  ahead.flicker.year.utc_offset_minutes = 90;
  const auto utc = flicker_runs(survey(open_place()).dwellings[0]), other = flicker_runs(survey(ahead).dwellings[0]);
  ASSERT_EQ(utc.size(), other.size());
  for (std::size_t i = 0; i < utc.size(); ++i) EXPECT_EQ(other[i].first, utc[i].first + 90);
}

TEST_F(DwellingSurveys, DoNotDependOnTheMemory) {
  std::vector<test::LineFeature> houses;
  for (int i = 0; i < 6; ++i)
    houses.push_back(test::box(400300 + 120.0 * i, 200480 + 10.0 * i, 400312 + 120.0 * i, 200490 + 10.0 * i, 7));
  build([](double east) { return 50 + 3 * std::sin(east / 40) + 70 * std::max(0.0, east / 3000 - 0.5); }, houses, 4);
  DwellingsRequest request = open_place();
  request.turbines.turbines.push_back(turbine(400700, 200100, 2));
  request.dwellings.places.clear();
  const DwellingsSurvey all = survey(request);
  ASSERT_GT(minutes_of(all), 0U);
  request.memory_bytes = 1;
  const DwellingsSurvey parts = survey(request);
  EXPECT_NE(parts.statistics.triangles, all.statistics.triangles) << "this is no survey in segments";
  expect_same(all, parts);
}

TEST_F(DwellingSurveys, RefuseWhatMakesNoSense) {
  build([](double) { return 50; }, {test::box(401090, 200390, 401110, 200410, 8)});
  expect_refused(open_place(), "turbines", "stands within a building of houses");
  DwellingsRequest request = open_place();
  request.themes = ThemeChoice::none();
  DwellingsRequest other = request;
  other.flicker.year.year = 1700;
  expect_refused(other, "year", "known from 1950 to 2100");
  other = request, other.flicker.least_elevation_deg = 70;
  expect_refused(other, "least_elevation_deg", "does not rise 70 degrees high there in 2027");
  other = request, other.dwellings.places[0].position = {402990, 200500};
  other.radius = 100, other.flicker.reach_diameters = 1;
  expect_refused(other, "radius", "no dwelling is within");
  other = request, other.turbines.turbines[0].position = {500000, 200500};
  expect_refused(other, "turbines", "no data under any");
  other = request, other.dwellings.places.clear();
  expect_refused(other, "themes", "none of them has buildings");
  other = request, other.dwelling_theme = "houses";
  expect_refused(other, "dwelling_theme", "no chosen theme of buildings");
}

TEST_F(DwellingSurveys, StopSoonAfterTheyAreToldTo) {
  test::import_alexandria(store_);
  DwellingsRequest request;
  request.turbines.turbines = {turbine(321560, 4297500), turbine(321950, 4297900, 2)};
  const Store store(store_);
  test::Impatient counted(std::numeric_limits<int>::max());
  survey_dwellings(store, request, counted);
  for (const int part : {10, 2}) {
    test::Impatient impatient(counted.asked() - counted.asked() / part);
    EXPECT_THROW(survey_dwellings(store, request, impatient), Cancelled);
  }
}

}  // namespace
}  // namespace itin::viewshed
