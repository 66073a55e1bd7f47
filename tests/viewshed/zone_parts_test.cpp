// Zones of visibility computed in parts, against the same all at once.
#include "turbines/zone_parts.hpp"

#include <cmath>
#include <filesystem>
#include <map>
#include <random>

#include <gtest/gtest.h>

#include <itin/byte_archive.hpp>
#include <itin/error.hpp>
#include <itin/import.hpp>
#include <viewshed/tasks.hpp>
#include <viewshed/turbines.hpp>
#include <viewshed/viewshed.hpp>
#include <viewshed/zone_files.hpp>

#include "support/file_bytes.hpp"
#include "support/houses.hpp"
#include "support/raster_file.hpp"
#include "support/same_zone.hpp"
#include "support/seed.hpp"
#include "support/temporary_directory.hpp"
#include "support/terrain_tin.hpp"
#include "support/vector_file.hpp"
#include "turbines/zone_request.hpp"

namespace itin::viewshed {
namespace {

constexpr int kZoneSide = 100;
constexpr double kZoneStep = 25;
constexpr Point2 kZoneCorner{300000, 200000};

/// Hills with a lake of no data and some houses, and two farms.
class ZoneParts : public testing::Test {
 protected:
  void SetUp() override {
    const std::vector<double> z = test::fractal_heights(129, 150, 0.5, test::seed());
    test::write_raster(directory_.file("t.tif"), {kZoneCorner.x, kZoneCorner.y, kZoneStep, kZoneSide, kZoneSide, 27700},
                       [&](int c, int r) {
                         if (std::hypot(c - 60, r - 45) < 5) return std::nan("");
                         return z[static_cast<std::size_t>(r) * 129 + static_cast<std::size_t>(c)];
                       });
    ImportOptions terrain;
    terrain.sources = {directory_.file("t.tif")};
    import_terrain(path(), terrain, progress_);
    add_houses();
    for (std::size_t k = 1; k <= 5; ++k) {
      Turbine t;
      t.number = k, t.farm = k < 4 ? "west" : "east";
      t.position = {kZoneCorner.x + (k < 4 ? 500 : 1900) + 90.0 * static_cast<double>(k), kZoneCorner.y - 900};
      t.tip_height = 100, t.hub_height = 60, t.rotor_diameter = 80, t.radius = 1200;
      request_.turbines.push_back(t);
    }
    request_.cell_size = 10;
    request_.themes = ThemeChoice::all();
  }

  std::string path() { return directory_.file("t.itin"); }

  void add_houses() {
    std::mt19937 random(test::seed());
    std::uniform_real_distribution<double> place(100, (kZoneSide - 1) * kZoneStep - 100);
    std::vector<test::LineFeature> houses;
    for (int i = 0; i < 40; ++i) {
      const double x = kZoneCorner.x + place(random), y = kZoneCorner.y - place(random);
      houses.push_back(test::box(x, y, x + 20, y + 12, 15));
    }
    test::import_houses(path(), directory_.file("h.geojson"), houses);
  }

  Zone survey(std::optional<std::uint64_t> memory) {
    request_.memory_bytes = memory;
    return survey_turbines(Store(path()), request_, progress_);
  }

  static void expect_same(const Zone& a, const Zone& b) {
    EXPECT_EQ(a.statistics.lines, b.statistics.lines);
    test::expect_same(a.bare, b.bare);
    ASSERT_EQ(a.screened.has_value(), b.screened.has_value());
    if (a.screened) test::expect_same(*a.screened, *b.screened);
    ASSERT_EQ(a.radar.has_value(), b.radar.has_value());
    if (a.radar) {
      EXPECT_EQ(a.radar->ground_m, b.radar->ground_m);
      test::expect_same(a.radar->height_m, b.radar->height_m);
      EXPECT_EQ(a.radar->turbine_m, b.radar->turbine_m);
      test::expect_same(a.radar->undecided_height_m, b.radar->undecided_height_m);
      EXPECT_EQ(a.radar->undecided_turbine_m, b.radar->undecided_turbine_m);
    }
    EXPECT_EQ(a.warnings, b.warnings);
  }

  /// With what holds a part of the surfaces alone.
  Zone survey_in_parts(const Zone& whole, double share) {
    const double surfaces = 110 * static_cast<double>(whole.statistics.triangles);
    Zone parts = survey(bytes_beside_surfaces(whole) + static_cast<std::uint64_t>(share * surfaces));
    EXPECT_GT(zone_parts(Store(path()), parts, whole.screened.has_value()).size(), 1U);
    return parts;
  }

  void expect_parts_make_the_whole() {
    const Zone whole = survey(std::nullopt);
    for (const double share : {0.6, 0.4}) expect_same(survey_in_parts(whole, share), whole);
    expect_same(survey_in_tasks(20000), whole);
    expect_same(survey_in_tasks(1), whole);
    expect_parts_read_again(whole, 20000);
  }

  /// In tasks, the last one first, all of them by other objects than the one that puts them together.
  Zone survey_in_tasks(std::uint64_t most_cells) {
    request_.memory_bytes.reset();
    const Store store(path());
    ZoneTasks tasks(store, request_, most_cells, progress_);
    EXPECT_GT(tasks.list().size(), 1U);
    for (std::size_t i = tasks.list().size(); i-- > 0;) {
      const ZoneTasks other(store, request_, most_cells, progress_);
      tasks.add(i, other.answer(i, progress_));
    }
    return tasks.take();
  }

  /// All files that are written of a zone, less its pictures.
  std::map<std::string, std::string> files_of(const Zone& zone) {
    const std::string folder = directory_.file("files");
    std::filesystem::remove_all(folder);
    std::filesystem::create_directory(folder);
    write_zone_rasters(folder, zone, {});
    std::map<std::string, std::string> files{
        {"areas", area_table(zone)}, {"totals", area_totals(zone)}, {"farms", combination_table(zone)}};
    for (const auto& entry : std::filesystem::directory_iterator(folder))
      files[entry.path().filename().string()] = test::file_bytes(entry.path().string());
    return files;
  }

  /// What is read again from the answers is what a zone holds, and so is what is written of it.
  void expect_parts_read_again(const Zone& zone, std::uint64_t most_cells) {
    const Store store(path());
    ZoneTasks tasks(store, request_, most_cells, progress_);
    std::vector<std::string> answers;
    for (std::size_t i = 0; i < tasks.list().size(); ++i) answers.push_back(tasks.answer(i, progress_));
    tasks.read_again_by([&](std::size_t task) { return answers.at(task); });
    for (std::size_t i = answers.size(); i-- > 0;) tasks.add(i, answers[i]);
    const Zone merged = tasks.take();
    ASSERT_TRUE(merged.parts);
    EXPECT_EQ(merged.bare.tip_count, zone.bare.tip_count);
    EXPECT_TRUE(merged.bare.turbines.empty());
    EXPECT_TRUE(merged.bare.visible_height_m.empty());
    const std::map<std::string, std::string> expected = files_of(zone), found = files_of(merged);
    EXPECT_GT(expected.size(), 20U);
    ASSERT_EQ(found.size(), expected.size());
    for (const auto& [name, bytes] : expected) EXPECT_TRUE(found.at(name) == bytes) << name;
    answers.back().pop_back();
    EXPECT_THROW(files_of(merged), NotThoseValues);
  }

  /// North of the lake, which lies between it and some of the cells.
  void add_radar() { request_.radar = Observer{"radar", {kZoneCorner.x + 1530, kZoneCorner.y - 260}, 15}; }

  /// With the engine of viewsheds, which looks from the radar alone. What is certainly seen is seen if voids block.
  void expect_heights_of_a_viewshed(const Zone& zone) {
    Request request;
    request.observers = {*request_.radar};
    request.mode = Mode::kHeight;
    request.grid = zone.grid;
    request.nodata = request_.nodata == NoData::kUnknown ? NoData::kBlock : request_.nodata;
    const Result result = compute(Store(path()), request, progress_);
    std::size_t high = 0;
    for (std::size_t i = 0; i < result.get<LeastHeights>().height_m.size(); ++i) {
      const float expected = result.get<LeastHeights>().height_m[i], found = zone.radar->height_m[i];
      ASSERT_EQ(std::isnan(expected), std::isnan(found)) << "cell " << i;
      if (std::isnan(expected)) continue;
      ASSERT_NEAR(expected, found, 1e-3) << "cell " << i;
      high += expected > 1 ? 1 : 0;
    }
    EXPECT_GT(high, 100U);
  }

  test::TemporaryDirectory directory_;
  ZoneRequest request_;
  NoProgress progress_;
};

TEST_F(ZoneParts, MakeTheWhole) {
  expect_parts_make_the_whole();
  EXPECT_TRUE(survey(std::nullopt).leaves_open());
}

TEST_F(ZoneParts, LikewiseWhereWhatIsMissingHides) {
  request_.nodata = NoData::kBlock;
  expect_parts_make_the_whole();
}

/// The slow way: each turbine by itself, its visible heights summed up.
TEST_F(ZoneParts, SumUpWhatEachTurbineShows) {
  const Zone unweighted = survey(std::nullopt);
  EXPECT_TRUE(unweighted.bare.height_sums_m.empty());
  request_.cell_size.reset();
  request_.grid = unweighted.grid;
  std::mt19937 random(test::seed());
  std::uniform_real_distribution<double> weight(0, 3);
  for (std::size_t i = 0; i < request_.grid->cell_count(); ++i) request_.weights.push_back(weight(random));
  const Zone whole = survey(std::nullopt);
  const std::vector<Turbine> turbines = request_.turbines;
  for (std::size_t k = 0; k < turbines.size(); ++k) {
    request_.turbines = {turbines[k]};
    const Zone alone = survey(std::nullopt);
    double bare = 0, screened = 0;
    for (std::size_t i = 0; i < request_.weights.size(); ++i) {
      if (std::isnan(alone.bare.visible_height_m[i])) continue;
      bare += request_.weights[i] * static_cast<double>(alone.bare.visible_height_m[i]);
      screened += request_.weights[i] * static_cast<double>(alone.screened->visible_height_m[i]);
    }
    EXPECT_GT(bare, screened);
    EXPECT_NEAR(whole.bare.height_sums_m[k], bare, 1e-6 * bare);
    EXPECT_NEAR(whole.screened->height_sums_m[k], screened, 1e-6 * bare);
  }
  request_.turbines = turbines;
  expect_same(survey_in_parts(whole, 0.4), whole);
  request_.weights.pop_back();
  EXPECT_THROW(survey(std::nullopt), InputError);
}

TEST_F(ZoneParts, HoldWhatARadarSees) {
  add_radar();
  const Zone whole = survey(std::nullopt);
  expect_heights_of_a_viewshed(whole);
  for (const double share : {0.8, 0.6, 0.4}) {
    const Zone parts = survey_in_parts(whole, share);
    expect_same(parts, whole);
    for (const ZonePart& part : zone_parts(Store(path()), parts, true))
      EXPECT_TRUE(part.tiles.empty() || part.radar_tiles.empty());
  }
  expect_same(survey_in_tasks(20000), whole);
}

TEST_F(ZoneParts, HoldWhatARadarSeesAcrossMissingGround) {
  add_radar();
  request_.nodata = NoData::kClear;
  const Zone clear = survey(std::nullopt);
  expect_heights_of_a_viewshed(clear);
  request_.nodata = NoData::kBlock;
  const Zone whole = survey(std::nullopt);
  EXPECT_GT(std::count_if(whole.radar->height_m.begin(), whole.radar->height_m.end(), [](float h) { return h != h; }),
            std::count_if(clear.radar->height_m.begin(), clear.radar->height_m.end(), [](float h) { return h != h; }));
  expect_heights_of_a_viewshed(whole);
  for (const double share : {0.8, 0.6, 0.4}) expect_same(survey_in_parts(whole, share), whole);
  expect_same(survey_in_tasks(20000), whole);
  request_.nodata = NoData::kUnknown;
  const Zone open = survey(std::nullopt);
  EXPECT_FALSE(open.radar->undecided_height_m.empty());
  expect_same(survey_in_tasks(20000), open);
}

/// Over the bare ground alone, on cells that reach beyond the turbines and the data, and with a turbine beyond them.
TEST_F(ZoneParts, HoldWhatARadarSeesFarFromTheTurbines) {
  add_radar();
  request_.themes.reset();
  request_.turbines.resize(2);
  for (Turbine& t : request_.turbines) t.radius = 300;
  request_.cell_size.reset();
  request_.grid = RasterGrid({kZoneCorner.x - 100, kZoneCorner.y + 100}, 10, 10, 280, 98);
  const Zone whole = survey(std::nullopt);
  expect_heights_of_a_viewshed(whole);
  for (const double share : {0.75, 0.55}) expect_same(survey_in_parts(whole, share), whole);
  expect_same(survey_in_tasks(5000), whole);
}

/// What a proposed farm's study area is, a task of other turbines alone must know, too.
TEST_F(ZoneParts, HoldAProposalAmongOthers) {
  for (Turbine& t : request_.turbines) {
    t.status = t.farm == "west" ? TurbineStatus::kProposed : TurbineStatus::kExisting;
    t.radius = 700;
  }
  expect_parts_make_the_whole();
  add_radar();
  expect_same(survey_in_tasks(1), survey(std::nullopt));
}

TEST_F(ZoneParts, NameThemesThatScreenNothing) {
  request_.themes = ThemeChoice::none();
  const Zone whole = survey(std::nullopt);
  EXPECT_EQ(whole.warnings.size(), 1U);
  expect_same(survey_in_tasks(20000), whole);
}

TEST_F(ZoneParts, ARadarOffTheDataIsRefused) {
  request_.radar = Observer{"radar", {kZoneCorner.x - 1000, kZoneCorner.y}, 15};
  EXPECT_THROW(survey(std::nullopt), InputError);
}

/// What the shadows of the lake take is no room for surfaces.
TEST_F(ZoneParts, LeaveRoomForTheShadowsOfMissingGround) {
  request_.themes.reset();
  const Zone whole = survey(std::nullopt);
  ASSERT_TRUE(whole.leaves_open());
  ASSERT_GT(whole.shadow_bytes, 5U * 4096 * sizeof(std::vector<std::uint32_t>));
  const auto parts_within = [&](std::uint64_t memory) {
    Zone zone = whole;
    zone.request.memory_bytes = memory;
    return zone_parts(Store(path()), zone, false).size();
  };
  std::uint64_t surfaces = whole.statistics.triangles;  // bytes; far too few
  while (parts_within(bytes_beside_surfaces(whole) + 100 * surfaces) > 1) surfaces += whole.statistics.triangles / 10;
  EXPECT_GT(parts_within(bytes_of_results(whole) + 100 * surfaces), 1U);
  request_.nodata = NoData::kClear;
  EXPECT_EQ(survey(std::nullopt).shadow_bytes, 0U);
}

TEST_F(ZoneParts, LittleMemoryIsRefusedWithWhatIsNeeded) {
  EXPECT_THROW(survey(100000), InputError);
}

}  // namespace
}  // namespace itin::viewshed
