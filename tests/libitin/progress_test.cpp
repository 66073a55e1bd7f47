// What every long call of the library tells of its progress: one fraction that never decreases and ends at 1.
#include <gtest/gtest.h>

#include <itin/call_progress.hpp>
#include <itin/import.hpp>
#include <itin/itin.hpp>
#include <itin/parallel.hpp>
#include <itin/tin_export.hpp>
#include <itin/verify.hpp>

#include "support/raster_file.hpp"
#include "support/temporary_directory.hpp"
#include "support/terrain_tin.hpp"
#include "support/told_progress.hpp"

namespace itin {
namespace {

TEST(CallProgress, PutsStepsTogether) {
  test::ToldProgress told;
  CallProgress call(told);
  call.step(0.25).report("reading", 0.5);
  call.step(0.5).report("sorting", 0);
  call.report("sorting", 1);
  call.step(1).report("writing", 0.2);
  call.finish();
  EXPECT_EQ(told.all(), (std::vector<double>{0.125, 0.25, 0.625, 0.7, 1}));
  EXPECT_EQ(told.of("writing"), (std::vector<double>{0.7, 1}));
}

TEST(CallProgress, NeverFallsBack) {
  test::ToldProgress told;
  CallProgress call(told);
  call.report("reading", 0.6);
  call.report("reading", 0.4);
  call.report("mending", 0.1);
  call.report("mending", 0.7);
  CallProgress inner(call.step(1));
  inner.report("looking", 0);
  inner.finish();
  call.finish();
  EXPECT_EQ(told.all(), (std::vector<double>{0.6, 0.6, 0.7, 0.7, 1}));
}

TEST(CallProgress, ListensToManyThreads) {
  test::ToldProgress told;
  CallProgress call(told);
  parallel_for(10000, [&](std::size_t i) { call.report("work", static_cast<double>(i) / 10000); });
  call.finish();
  told.expect_whole_call();
}

class ProgressOfCalls : public testing::Test {
 protected:
  template <class Call>
  void expect_whole(const Call& call, double most = 1) {
    test::ToldProgress told;
    call(told);
    told.expect_whole_call();
    told.expect_steps_up_to(most);
  }

  ImportOptions hills() {
    const std::vector<double> z = test::fractal_heights(513, 200, 0.55, 3);
    ImportOptions options;
    options.sources = {directory_.file("hills.tif")};
    test::write_raster(options.sources.front(), {300000, 210000, 10, 400, 400, 27700}, [&](int c, int r) {
      return z[static_cast<std::size_t>(r) * 513 + static_cast<std::size_t>(c)];
    });
    return options;
  }

  NoProgress progress_;
  const test::TemporaryDirectory directory_;
  const std::string store_ = directory_.file("hills.itin");
};

TEST_F(ProgressOfCalls, NeverFallsBackAndEndsAtOne) {
  const ImportOptions options = hills();
  expect_whole([&](Progress& p) { import_terrain(store_, options, p); }, 0.3);
  const Store store(store_);
  Tin tin;
  expect_whole([&](Progress& p) { tin = triangulate(store, Window::all(), Detail::tolerance(0), p); }, 0.6);
  expect_whole([&](Progress& p) {
    std::ignore =
        heights_at(store, std::vector<Point2>(100, {301000, 209000}), Detail::tolerance(0), ThemeChoice::none(), p);
  });
  expect_whole([&](Progress& p) {
    std::ignore =
        heights_at(store, RasterGrid({300000, 210000}, 5, 5, 600, 600), Detail::tolerance(0), ThemeChoice::none(), p);
  });
  tin = triangulate(store, Window::all(), Detail::tolerance(8), progress_);
  for (const char* const name : {"a.ply", "a.obj", "a.glb", "a.gpkg", "a.geojson"})
    expect_whole([&](Progress& p) { export_tin(tin, directory_.file(name), {}, p); });
  expect_whole(
      [&](Progress& p) { export_topology(tin, TopologyKind::TriangleBased, directory_.file("a.json"), {}, p); });
  expect_whole([&](Progress& p) { EXPECT_TRUE(check(store, p).empty()); });
  expect_whole([&](Progress& p) { EXPECT_TRUE(verify(store, {}, p).damage.empty()); });
}

/// Features take several passes.
TEST_F(ProgressOfCalls, NeverFallsBackWithFeatures) {
  const std::string data = std::string(ITIN_SOURCE_DIR) + "/scripts/demo-data/";
  ImportOptions terrain, buildings;
  terrain.sources = {data + "alexandria-dtm.tif"};
  buildings.sources = {data + "alexandria-buildings.geojson"};
  buildings.kind = ThemeKind::Buildings;
  buildings.height_field = "HEIGHT";
  expect_whole([&](Progress& p) { import_terrain(store_, terrain, p); });
  expect_whole([&](Progress& p) { import_lines(store_, buildings, p); });
  expect_whole([&](Progress& p) { import_terrain(store_, terrain, p); });
  expect_whole([&](Progress& p) { EXPECT_TRUE(verify(Store(store_), {}, p).damage.empty()); });
}

}  // namespace
}  // namespace itin
