// How far within their outlines the walls of a theme reach their height, as its imports ask for it.
#include <gmock/gmock.h>

#include <gtest/gtest.h>

#include <itin/error.hpp>
#include <itin/import.hpp>
#include <itin/store.hpp>
#include <itin/triangulate.hpp>

#include "support/raster_file.hpp"
#include "support/temporary_directory.hpp"
#include "support/vector_file.hpp"

namespace itin {
namespace {

class WallOffset : public testing::Test {
 protected:
  void SetUp() override { import_ground("west.tif", 300000); }

  void import_ground(const char* name, double xmin) {
    test::write_raster(path(name), {.xmin = xmin, .columns = 20, .rows = 20}, [](int, int) { return 100.0; });
    ImportOptions options;
    options.sources = {path(name)};
    import_terrain(path("s.itin"), options, progress_);
  }

  /// A house of 20 by 10 m, 8 m high.
  void import_house(double west, std::optional<double> offset, const char* theme = "houses") {
    const std::string file = path("h.geojson");
    test::write_lines(file, {test::box(west, 199600, west + 20, 199610, 8)}, true);
    ImportOptions options;
    options.sources = {file};
    options.kind = ThemeKind::Buildings;
    options.theme = theme;
    options.height_field = "h";
    options.wall_offset = offset;
    import_lines(path("s.itin"), options, progress_);
  }

  /// So far within the western side of a house.
  double height_within(double west, double metres) {
    const Store store(path("s.itin"));
    return heights_at(store, {{west + metres, 199605}}, Detail::tolerance(0), ThemeChoice::all(), progress_)
        .front()
        .value();
  }

  std::string path(const std::string& name) const { return directory_.file(name); }

 private:
  const test::TemporaryDirectory directory_;
  NoProgress progress_;
};

TEST_F(WallOffset, IsFiveCentimetresWhereNoImportAsksForMore) {
  import_house(300400, std::nullopt);
  EXPECT_DOUBLE_EQ(height_within(300400, 0.06), 108);
  EXPECT_FALSE(Store(path("s.itin")).metadata().themes.front().wall_offset);
}

TEST_F(WallOffset, IsKeptForLaterHousesAndOnNewGround) {
  import_house(300400, 0.5);
  const auto expect_walls = [&](double west) {
    EXPECT_NEAR(height_within(west, 0.25), 104, 0.1);
    EXPECT_LT(height_within(west, 0.48), 108);
    EXPECT_DOUBLE_EQ(height_within(west, 0.52), 108);
  };
  expect_walls(300400);
  import_house(300500, std::nullopt);
  expect_walls(300500);
  import_ground("east.tif", 301000);
  expect_walls(300400);
  EXPECT_EQ(Store(path("s.itin")).metadata().themes.front().wall_offset, 0.5);
}

TEST_F(WallOffset, IsOneForATheme) {
  import_house(300400, 0.5);
  EXPECT_THAT([&] { import_house(300500, 0.2); },
              testing::ThrowsMessage<InputError>(testing::HasSubstr("`wall_offset` of 0.5 m already, not 0.2 m")));
  import_house(300500, 0.5);
  import_house(300600, 0.2, "sheds");
  EXPECT_DOUBLE_EQ(height_within(300600, 0.22), 108);
  EXPECT_LT(height_within(300500, 0.22), 105);
}

TEST_F(WallOffset, IsRefusedWhereNoWallCanStandSo) {
  for (const double metres : {0.019, 10.5})
    EXPECT_THAT([&] { import_house(300400, metres); },
                testing::ThrowsMessage<InputError>(testing::HasSubstr("from 0.02 m (two steps of the grid) to 10 m")));
  EXPECT_TRUE(Store(path("s.itin")).metadata().themes.empty());
}

}  // namespace
}  // namespace itin
