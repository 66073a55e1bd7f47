// Rasters of heights that stand, against the prisms of their cells on the terrain.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <gmock/gmock.h>
#include <iostream>
#include <random>

#include <gdal_priv.h>
#include <gtest/gtest.h>

#include <itin/cross_section.hpp>
#include <itin/error.hpp>
#include <itin/feature_at.hpp>
#include <itin/import.hpp>
#include <itin/raster_values.hpp>
#include <itin/store.hpp>
#include <itin/triangulate.hpp>

#include "libitin/features/surface_comparison.hpp"
#include "support/houses.hpp"
#include "support/raster_file.hpp"
#include "support/seed.hpp"
#include "support/sound_store.hpp"
#include "support/temporary_directory.hpp"

namespace itin {
namespace {

using test::RasterShape;

/// Metres: walls stand this far within the edges of cells, and positions are rounded.
constexpr double kWall = 0.07;

class HeightRaster : public testing::Test {
 protected:
  double in(double low, double high) { return low + (high - low) * static_cast<double>(random_() % 1000000) / 1e6; }

  void import_hills() {
    const double phase = in(0, 6);
    test::write_raster(path("hills.tif"), {300000, 200000, 10, 24, 24, 27700}, [&](int c, int r) {
      return 50 + 9 * std::sin(c / 3.0 + phase) + 7 * std::cos(r / 2.5) + std::sin(c * r / 7.0);
    });
    ImportOptions options;
    options.sources = {path("hills.tif")};
    import_terrain(path("s.itin"), options, progress_);
  }

  ImportOptions heights(ThemeKind kind, const RasterShape& shape, const std::function<double(int, int)>& height) {
    test::write_raster(path("heights.tif"), shape, height);
    ImportOptions options;
    options.sources = {path("heights.tif")};
    options.kind = kind;
    return options;
  }

  /// The height of the cell that a place is in, NaN beyond the raster; nothing near the edge of a cell.
  static std::optional<double> cell_at(const RasterValues& raster, Point2 p) {
    const double column = (p.x - raster.grid.north_west().x) / raster.grid.cell_width(),
                 row = (raster.grid.north_west().y - p.y) / raster.grid.cell_height();
    const double near = kWall / raster.grid.cell_width();
    for (const double v : {column, row})
      if (std::abs(v - std::round(v)) < near) return std::nullopt;
    if (column < 0 || row < 0 || column > static_cast<double>(raster.grid.columns()) ||
        row > static_cast<double>(raster.grid.rows()))
      return std::nan("");
    return raster.values[raster.grid.index({static_cast<std::int64_t>(column), static_cast<std::int64_t>(row)})];
  }

  /// How high the cell stands above the ground.
  static double rounded(double above, double step, double threshold, HeightRounding rounding) {
    if (!(above > 0 && above >= threshold)) return 0;
    const double steps = above / step;
    return step * (rounding == HeightRounding::up     ? std::ceil(steps - 1e-9)
                   : rounding == HeightRounding::down ? std::floor(steps + 1e-9)
                                                      : std::floor(steps + 0.5));
  }

  std::string path(const std::string& name) const { return directory_.file(name); }

  std::mt19937 random_{test::seed()};
  NoProgress progress_;
  test::TemporaryDirectory directory_;
};

TEST_F(HeightRaster, OutlinesOfItsThemeThatDoNotStandAreKnownByTheirNumbers) {
  import_hills();
  ImportOptions options =
      heights(ThemeKind::Buildings, {300031, 199961, 2, 70, 30, 27700}, [](int c, int) { return c < 5 ? 6.0 : 0.0; });
  options.theme = "town";
  import_lines(path("s.itin"), options, progress_);
  const Store rasters(path("s.itin"));
  const auto parts = static_cast<std::int64_t>(features_of(rasters, 1).size());
  // The ground ends at 300235 in the east.
  test::import_raised(path("s.itin"), path("town.geojson"), ThemeKind::Buildings, "town",
                      {test::box(300300, 199900, 300310, 199910, 8), test::box(300200, 199850, 300210, 199860, 8),
                       test::box(300400, 199900, 300410, 199910, 8), test::box(300420, 199900, 300430, 199910, 8)});
  const Store store(path("s.itin"));
  ASSERT_EQ(store.metadata().themes.size(), 1U);
  const std::vector<FeatureRun>& left_out = store.metadata().themes[0].left_out;
  ASSERT_FALSE(left_out.empty());
  // What the sources hold decides which of them has the first numbers.
  const std::int64_t first = left_out[0].first;
  EXPECT_TRUE(first == 0 || first == parts) << first;
  EXPECT_EQ(left_out, (std::vector<FeatureRun>{{first, first}, {first + 2, first + 3}}));
}

TEST_F(HeightRaster, StandsAsThePrismsOfItsCells) {
  struct Way {
    ThemeKind kind;
    HeightRounding rounding;
    double step, threshold;
  };
  for (const Way& way :
       {Way{ThemeKind::Vegetation, HeightRounding::nearest, 2, 2},
        Way{ThemeKind::Vegetation, HeightRounding::up, 3, 0.5}, Way{ThemeKind::Buildings, HeightRounding::down, 0.5, 1},
        Way{ThemeKind::Surface, HeightRounding::nearest, 2.5, 1.5},
        Way{ThemeKind::Surface, HeightRounding::down, 1, 2}}) {
    SCOPED_TRACE(std::string(name_of(way.kind)) + " in steps of " + std::to_string(way.step));
    std::filesystem::remove(path("s.itin"));
    import_hills();
    // Parts of 64 cells meet within it.
    const RasterShape shape{300031, 199961, 2, 70, 66, 27700};
    const bool surface = way.kind == ThemeKind::Surface;
    std::vector<double> cells;
    for (int i = 0; i < shape.columns * shape.rows; ++i)
      cells.push_back(random_() % 12 == 0 ? std::nan("") : random_() % 3 == 0 ? 0 : std::round(in(-20, 120)) / 10);
    const Store bare(path("s.itin"));
    const Tin ground = triangulate(bare, Window::all(), Detail::tolerance(0), progress_);
    const TerrainHeights low(ground);
    const auto quantised = [&](Point2 p) {
      const GridPoint q = ground.grid.quantise({p.x, p.y, 0});
      return Position{q.x, q.y};
    };
    ImportOptions options = heights(way.kind, shape, [&](int c, int r) {
      const double h = cells[static_cast<std::size_t>(r * shape.columns + c)];
      const Point2 centre{shape.xmin + (c + 0.5) * shape.step, shape.ymax - (r + 0.5) * shape.step};
      return surface ? h + *low.height_at(quantised(centre)) : h;
    });
    options.height_step = way.step, options.height_threshold = way.threshold, options.height_rounding = way.rounding;
    const ImportReport report = import_lines(path("s.itin"), options, progress_);
    EXPECT_EQ(report.cells + report.voids, cells.size());
    EXPECT_GT(report.features, 100U);
    EXPECT_EQ(report.refused, 0U);

    const Store store(path("s.itin"));
    test::expect_sound(store);
    const Tin raised = triangulate(store, Window::all(), Detail::tolerance(0), progress_, ThemeChoice::all());
    const TerrainHeights high(raised);
    const RasterValues raster = read_raster_values(path("heights.tif"), store.metadata().crs_wkt);
    double worst = 0;
    int compared = 0;
    for (int i = 0; i < 20000; ++i) {
      const Point2 p{in(300020, 300190), in(199820, 199970)};
      const auto cell = cell_at(raster, p);
      if (!cell) continue;
      const Point2 centre{300031 + 2 * (std::floor((p.x - 300031) / 2) + 0.5),
                          199961 - 2 * (std::floor((199961 - p.y) / 2) + 0.5)};
      const double above = std::isnan(*cell) ? 0 : surface ? *cell - *low.height_at(quantised(centre)) : *cell;
      const double expected = rounded(above, way.step, way.threshold, way.rounding);
      // Elevations in single precision may lie on either side of a step.
      const double beside = rounded(above + 0.002, way.step, way.threshold, way.rounding),
                   before = rounded(above - 0.002, way.step, way.threshold, way.rounding);
      if (beside != before) continue;
      const double found = *high.height_at(quantised(p)) - *low.height_at(quantised(p));
      worst = std::max(worst, std::abs(found - expected));
      ++compared;
    }
    std::cout << compared << " places, off by up to " << worst << " m\n";
    EXPECT_GT(compared, 10000);
    EXPECT_LT(worst, 0.05);
    test::SurfaceComparison comparison(ground, raised);
    comparison.everywhere(random_);
    comparison.expect_only_raised();
    comparison.expect_ground_kept();
  }
}

TEST_F(HeightRaster, IsOnTheWayOfALine) {
  import_hills();
  // One cell of 8 m, 20 m high, amid lower ones.
  const ImportOptions options = heights(ThemeKind::Vegetation, {300100, 199900, 8, 3, 3, 27700},
                                        [](int c, int r) { return c == 1 && r == 1 ? 20.4 : 4; });
  import_lines(path("s.itin"), options, progress_);
  const Store store(path("s.itin"));
  const CrossSection with = cross_section(store, {300080, 199888}, {300150, 199888}, Detail::tolerance(0),
                                          ThemeChoice::all()),
                     bare = cross_section(store, {300080, 199888}, {300150, 199888}, Detail::tolerance(0));
  const auto height_at = [](const CrossSection& section, double distance) {
    const auto after = std::find_if(section.breakpoints.begin() + 1, section.breakpoints.end(),
                                    [&](const Breakpoint& b) { return b.distance >= distance; });
    const Breakpoint &a = *(after - 1), &b = *after;
    return a.position.z + (distance - a.distance) / (b.distance - a.distance) * (b.position.z - a.position.z);
  };
  for (double d = 0.3; d < 69; d += 1.7) {
    const double expected = d < 20 || d > 44 ? 0 : d < 28 || d > 36 ? 4 : 20;
    EXPECT_NEAR(height_at(with, d) - height_at(bare, d), expected, 0.03) << d;
  }
  const auto at = features_at(store, 1, {{300112, 199888}, {300200, 199888}});
  ASSERT_TRUE(at[0]);
  EXPECT_EQ(at[0]->name, "heights.tif");
  EXPECT_FALSE(at[1]);
}

/// A low patch that higher ones enclose is there at the levels that these are at, and never leaves a hole.
TEST_F(HeightRaster, IsKeptOrDroppedAsAWhole) {
  import_hills();
  const ImportOptions options = heights(ThemeKind::Vegetation, {300060, 199940, 5, 20, 20, 27700},
                                        [](int c, int r) { return c % 4 == 2 && r % 4 == 2 ? 4 : 12; });
  import_lines(path("s.itin"), options, progress_);
  EXPECT_EQ(Store(path("s.itin")).metadata().parts.size(), 1U);
}

TEST_F(HeightRaster, LeavesOutWhatReachesBeyondTheGround) {
  import_hills();
  // The ground ends at x = 300235, amid the sixth column.
  const ImportOptions options =
      heights(ThemeKind::Surface, {300208, 199900, 5, 9, 4, 27700}, [](int, int) { return 100; });
  const ImportReport report = import_lines(path("s.itin"), options, progress_);
  EXPECT_THAT(report.warnings, testing::Contains(testing::HasSubstr("heights.tif: 16 cells left out: beyond")));
  const Store store(path("s.itin"));
  test::expect_sound(store);
  EXPECT_GT(store.greatest_feature_height(ThemeChoice::all(), {300228, 199890, 300229, 199891}), 20);
}

/// As houses do, it stands as soon as there is ground.
TEST_F(HeightRaster, WaitsForItsGround) {
  import_hills();
  const RasterShape east{300240, 199900, 5, 6, 6, 27700};
  const ImportReport report =
      import_lines(path("s.itin"), heights(ThemeKind::Vegetation, east, [](int, int) { return 5; }), progress_);
  EXPECT_THAT(report.warnings, testing::Contains(testing::HasSubstr("lies wholly beyond the ground of the store")));
  EXPECT_EQ(report.features, 0U);
  test::expect_sound(Store(path("s.itin")));
  test::write_raster(path("more.tif"), {300200, 200000, 10, 24, 24, 27700}, [](int, int) { return 40; });
  ImportOptions more;
  more.sources = {path("more.tif")};
  import_terrain(path("s.itin"), more, progress_);
  const Store store(path("s.itin"));
  test::expect_sound(store);
  EXPECT_EQ(store.metadata().themes[0].features, 1U);
}

TEST_F(HeightRaster, RefusesWhatItCannotRaise) {
  import_hills();
  const RasterShape shape{300060, 199940, 5, 20, 20, 27700};
  const auto expect_refused = [&](const ImportOptions& options, const std::string& why) {
    const auto before = std::filesystem::file_size(path("s.itin"));
    try {
      import_lines(path("s.itin"), options, progress_);
      ADD_FAILURE() << why;
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr(why));
    }
    EXPECT_EQ(std::filesystem::file_size(path("s.itin")), before);
  };
  expect_refused(heights(ThemeKind::Vegetation, shape, [](int, int) { return std::nan(""); }), "holds no height");
  expect_refused(heights(ThemeKind::Vegetation, shape, [](int, int) { return 1.5; }),
                 "no cell is as high as `height_threshold`, 2 m; the highest has 1.5 m");
  expect_refused(heights(ThemeKind::Vegetation, shape, [](int c, int) { return c == 7 ? 1500 : 5; }),
                 "column 7, row 0 has 1500 m above the ground");
  RasterShape utm = shape;
  utm.epsg = 32630;
  expect_refused(heights(ThemeKind::Vegetation, utm, [](int, int) { return 5; }), "gdalwarp -t_srs");
  ImportOptions options = heights(ThemeKind::Vegetation, shape, [](int, int) { return 5; });
  options.height_step = 0.0015;
  expect_refused(options, "`height_step` 0.0015: give 0.01 to 1000 metres, in whole millimetres");
  options.height_step.reset(), options.height_field = "h";
  expect_refused(options, "`height_field`: does nothing for rasters of heights above the ground");
  options.height_field.clear(), options.kind = ThemeKind::Walls, options.height_step = 2;
  expect_refused(options, "`height_step`");
}

TEST_F(HeightRaster, OfNoiseNamesTheStepToRaise) {
  import_hills();
  ImportOptions options =
      heights(ThemeKind::Vegetation, {300031, 199961, 1, 150, 150, 27700}, [&](int, int) { return in(2, 30); });
  options.height_step = 0.01, options.memory_bytes = std::uint64_t{100} << 20;
  try {
    import_lines(path("s.itin"), options, progress_);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("raise `height_step` (it is 0.01 m) or `height_threshold` (2 m)"));
  }
}

TEST_F(HeightRaster, OfARealWoodIsAsHighAsItsCells) {
  const std::string data = std::string(ITIN_DATA_DIR) + "/ea-vom-dartmoor-newforest/";
  if (!std::filesystem::exists(data)) GTEST_SKIP() << data << " is not there";
  GDALAllRegister();
  const GDALDatasetUniquePtr whole(GDALDataset::Open((data + "fingle_woods_vom.tif").c_str()));
  std::array<double, 6> affine{};
  whole->GetGeoTransform(affine.data());
  constexpr int kSideOfWood = 130, kColumn = 200, kRow = 250;
  std::vector<double> cells(kSideOfWood * kSideOfWood);
  ASSERT_EQ(whole->GetRasterBand(1)->RasterIO(GF_Read, kColumn, kRow, kSideOfWood, kSideOfWood, cells.data(),
                                              kSideOfWood, kSideOfWood, GDT_Float64, 0, 0, nullptr),
            CE_None);
  ImportOptions options;
  options.sources = {data + "tiles/sx78.zip", data + "tiles/sx79.zip"};
  import_terrain(path("s.itin"), options, progress_);
  const ImportReport report = import_lines(
      path("s.itin"),
      heights(ThemeKind::Vegetation, {affine[0] + kColumn, affine[3] - kRow, 1, kSideOfWood, kSideOfWood, 27700},
              [&](int c, int r) { return cells[static_cast<std::size_t>(r * kSideOfWood + c)]; }),
      progress_);
  const Store store(path("s.itin"));
  test::expect_sound(store);
  const RasterValues raster = read_raster_values(path("heights.tif"), store.metadata().crs_wkt);
  const Window window = Window::box(raster.grid.bounds());
  const Tin bare = triangulate(store, window, Detail::tolerance(0), progress_, ThemeChoice::none()),
            tin = triangulate(store, window, Detail::tolerance(0), progress_, ThemeChoice::all());
  const TerrainHeights low(bare), high(tin);
  double worst = 0, rise = 0, measured = 0;
  for (int row = 0; row < kSideOfWood; ++row)
    for (int column = 0; column < kSideOfWood; ++column) {
      const Point2 centre = raster.grid.centre(column, row);
      const GridPoint p = bare.grid.quantise({centre.x, centre.y, 0});
      const double h = raster.values[raster.grid.index({column, row})],
                   above = *high.height_at({p.x, p.y}) - *low.height_at({p.x, p.y});
      worst = std::max(worst, std::abs(above - rounded(std::round(h * 1000) / 1000, 2, 2, HeightRounding::nearest)));
      rise += above, measured += h < 2 ? 0 : h;
    }
  std::cout << report.features << " features in " << report.seconds << " s; off by up to " << worst
            << " m from steps; mean canopy " << rise / (kSideOfWood * kSideOfWood) << " m, measured "
            << measured / (kSideOfWood * kSideOfWood) << " m\n";
  EXPECT_LT(worst, 0.03);
  EXPECT_NEAR(rise / measured, 1, 0.01);
}

}  // namespace
}  // namespace itin
