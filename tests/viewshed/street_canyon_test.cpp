// A street between two rows of houses, worked out by hand: flat ground at 50 m; a row 10 m high from x = 100 to 120,
// the street from 120 to 140, and a row 20 m high from 140 to 160; all from y = 40 to 240, seen along y = 140.
#include <gtest/gtest.h>

#include <itin/import.hpp>
#include <itin/store.hpp>
#include <viewshed/viewshed.hpp>

#include "support/raster_file.hpp"
#include "support/temporary_directory.hpp"
#include "support/vector_file.hpp"

namespace itin {
namespace {

class StreetCanyon : public testing::Test {
 protected:
  void SetUp() override {
    test::write_raster(directory_.file("t.tif"), {300000, 200280, 10, 29, 29, 27700}, [](int, int) { return 50.0; });
    ImportOptions options;
    options.sources = {directory_.file("t.tif")};
    NoProgress progress;
    import_terrain(directory_.file("s.itin"), options, progress);
    const auto row = [](double from, double to, double height) {
      return test::box(300000 + from, 200040, 300000 + to, 200240, height);
    };
    test::write_lines(directory_.file("b.geojson"), {row(100, 120, 10), row(140, 160, 20)}, true);
    options.sources = {directory_.file("b.geojson")};
    options.kind = ThemeKind::Buildings;
    options.height_field = "h";
    ASSERT_EQ(import_lines(directory_.file("s.itin"), options, progress).features, 2u);
    request_.cell_size = 1;
    request_.earth = Earth::flat();
    request_.themes = ThemeChoice::all();
  }

  /// Whether the target in the cell east of x along the middle of the street's row is seen.
  bool sees(double from, double to, double target_height) {
    request_.observers = {{"eye", {300000 + from, 200140.5}, 2}};
    request_.target_height = target_height;
    NoProgress progress;
    const viewshed::Result result = viewshed::compute(Store(directory_.file("s.itin")), request_, progress);
    const auto cell = result.grid.cell_at({300000 + to, 200140.5});
    EXPECT_TRUE(cell);
    const viewshed::Verdict value = result.visible[result.grid.index(*cell)];
    EXPECT_NE(value, viewshed::Verdict::kOutside);
    return value == viewshed::Verdict::kVisible;
  }

  test::TemporaryDirectory directory_;
  viewshed::Request request_;
};

TEST_F(StreetCanyon, FromTheGroundBeforeIt) {
  EXPECT_TRUE(sees(80.5, 90.5, 0));
  EXPECT_FALSE(sees(80.5, 130.5, 0));  // the street
  EXPECT_FALSE(sees(80.5, 110.5, 0));  // the ground within the low row
  EXPECT_FALSE(sees(80.5, 110.5, 9));  // still within it
  // The low row's eaves rise 8 m in 19.55 m; 130.5 lies 50 m away: a mast must reach 52 + 20.46 - 50 m.
  EXPECT_FALSE(sees(80.5, 130.5, 22.2));
  EXPECT_TRUE(sees(80.5, 130.5, 22.7));
  // Behind the high row, 20 m: its eaves at 140.05 rise 18 m in 59.55 m, less steeply than the low row's. At 170.5 the
  // low row's edge asks for 52 + 90 * 8 / 19.55 - 50 = 38.83 m.
  EXPECT_FALSE(sees(80.5, 170.5, 38.5));
  EXPECT_TRUE(sees(80.5, 170.5, 39.1));
}

TEST_F(StreetCanyon, FromTheStreet) {
  EXPECT_TRUE(sees(130.5, 125.5, 0));
  EXPECT_FALSE(sees(130.5, 90.5, 0));
  EXPECT_FALSE(sees(130.5, 110.5, 0));  // a target on the ground within a house is hidden
  request_.targets_on_surface = true;   // the roof is hidden too, by its own edge: 8 m in 10.55 m
  EXPECT_FALSE(sees(130.5, 110.5, 0));
  EXPECT_FALSE(sees(130.5, 110.5, 7.0));  // 52 + 20 * 8 / 10.55 = 67.17, 7.17 m above the roof
  EXPECT_TRUE(sees(130.5, 110.5, 7.3));
}

TEST_F(StreetCanyon, FromTheLowRoof) {
  request_.observers_on_surface = true;
  // Its eye at 62 looks down over the edge at 119.95, 2 m lower, 9.45 m off: at 130.5 down to 57.77 m.
  EXPECT_FALSE(sees(110.5, 130.5, 7.6));
  EXPECT_TRUE(sees(110.5, 130.5, 7.9));
  EXPECT_FALSE(sees(110.5, 150.5, 0));  // within the high row
  request_.targets_on_surface = true;   // its roof, behind its edge: 8 m up in 29.55 m, 10.83 m up at 40 m
  EXPECT_FALSE(sees(110.5, 150.5, 2.7));
  EXPECT_TRUE(sees(110.5, 150.5, 3.0));
}

TEST_F(StreetCanyon, WithoutTheThemeItIsFlatGround) {
  request_.themes = ThemeChoice::none();
  EXPECT_TRUE(sees(80.5, 130.5, 0));
  EXPECT_TRUE(sees(80.5, 250.5, 0));
}

}  // namespace
}  // namespace itin
