// What is decided of surfaces with features by bounds alone is never wrong: over random towns of every kind of feature,
// Alexandria, Delft, and the canopy of Fingle Woods on Dartmoor. Two surfaces hold the one with features between them;
// certified blocks are what the whole surface says of them; zones of turbines that leave out ground are those over all
// of it; sites chosen by bounds are those of brute force (Delft's: siting/town_siting_test.cpp).
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include <gdal_priv.h>
#include <gtest/gtest.h>

#include <itin/import.hpp>
#include <itin/tin_heights.hpp>
#include <itin/triangulate.hpp>
#include <viewshed/result.hpp>
#include <viewshed/site_coverage.hpp>
#include <viewshed/turbines.hpp>

#include "certify/level_source.hpp"
#include "features/mesh/terrain_heights.hpp"
#include "support/full_detail.hpp"
#include "support/raster_file.hpp"
#include "support/same_zone.hpp"
#include "support/seed.hpp"
#include "support/temporary_directory.hpp"
#include "support/terrain_tin.hpp"
#include "support/vector_file.hpp"
#include "viewshed/siting/proven_choice.hpp"
#include "window/envelope.hpp"

namespace itin::viewshed {
namespace {

using Features = std::vector<test::LineFeature>;

constexpr double kPlaceSide = 900;
constexpr Point2 kPlaceCorner{300000, 200000};

class RaisedPlace : public testing::Test {
 protected:
  std::string file(const std::string& name) const { return directory_.file(name); }
  static std::string shared(const std::string& name) { return std::string(ITIN_DATA_DIR) + "/" + name; }
  double in(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }

  void import_ground(const std::vector<std::string>& sources, const std::string& crs = "",
                     const std::vector<int>& classes = {}) {
    ImportOptions options;
    options.sources = sources;
    options.crs = crs;
    options.classes = classes;
    import_terrain(file("s.itin"), options, progress_);
  }

  void import_features(const std::string& source, ThemeKind kind, const std::string& theme,
                       const std::string& height_field, const std::string& crs = "",
                       std::optional<BaseRule> flat_base = std::nullopt) {
    ImportOptions options;
    options.sources = {source};
    options.kind = kind;
    options.theme = theme;
    options.height_field = height_field;
    options.crs = crs;
    options.base = flat_base;
    if (flat_base) options.foundation = Foundation::flat;
    import_lines(file("s.itin"), options, progress_);
  }

  void add(const Features& features, ThemeKind kind, const std::string& theme,
           std::optional<BaseRule> flat_base = std::nullopt) {
    test::write_lines(file(theme + ".geojson"), features, true);
    import_features(file(theme + ".geojson"), kind, theme, "h", "", flat_base);
  }

  /// Turned anyhow.
  test::LineFeature box(double width, double depth, double height) {
    const Point2 p{kPlaceCorner.x + in(80, kPlaceSide - 80), kPlaceCorner.y - in(80, kPlaceSide - 80)};
    return test::turned_box(p, width, depth, in(0, 6), height);
  }
  Features boxes(int count, std::array<double, 2> size, std::array<double, 2> height) {
    Features result;
    for (int i = 0; i < count; ++i)
      result.push_back(box(in(size[0], size[1]), in(size[0], size[1]), in(height[0], height[1])));
    return result;
  }

  /// A low house on a flat foundation cuts through a ridge, and a turbine stands behind.
  void make_town(bool with_cuts) {
    const std::vector<double> z = test::fractal_heights(65, with_cuts ? 5 : 60, 0.5, test::seed());
    test::write_raster(
        file("t.tif"), {kPlaceCorner.x, kPlaceCorner.y, kPlaceSide / 60, 61, 61, 27700},
        [&](int c, int r) { return z[static_cast<std::size_t>(r * 65 + c)] + (with_cuts && r == 30 ? 25 : 0); });
    import_ground({file("t.tif")});
    add(boxes(40, {8, 25}, {3, 15}), ThemeKind::Buildings, "houses");
    add(boxes(3, {60, 120}, {8, 18}), ThemeKind::Vegetation, "woods");
    add(boxes(6, {20, 50}, {1, 2}), ThemeKind::Terraces, "terraces");
    Features walls;
    for (int i = 0; i < 20; ++i) walls.push_back(box(in(15, 50), 0.4, in(1.5, 2.5)));
    add(walls, ThemeKind::Walls, "walls");
    if (with_cuts) {
      Features houses = boxes(8, {10, 30}, {0.4, 6});
      houses.push_back(
          test::box(kPlaceCorner.x + 400, kPlaceCorner.y - 500, kPlaceCorner.x + 500, kPlaceCorner.y - 400, 0.5));
      add(houses, ThemeKind::Buildings, "cut", BaseRule::minimum);
      add(boxes(8, {10, 30}, {0.4, 6}), ThemeKind::Buildings, "filled_up", BaseRule::maximum);
      turbines_.push_back({kPlaceCorner.x + 450, kPlaceCorner.y - 520});
    }
    open();
  }

  void open() {
    store_.emplace(file("s.itin"));
    surface_ = triangulate(*store_, Window::all(), Detail::tolerance(0), progress_, ThemeChoice::all());
    ground_ = triangulate(*store_, Window::all(), Detail::tolerance(0), progress_);
    ASSERT_FALSE(surface_.raised_theme.empty());
    area_ = ground_.bounds();
  }

  /// A place with ground, not within a feature's walls.
  Point2 anywhere() {
    for (;;) {
      const Point2 p{in(area_.xmin, area_.xmax), in(area_.ymin, area_.ymax)};
      const auto low = height_on(ground_, p), high = height_on(surface_, p);
      if (low && high && *high - *low < 0.1) return p;
    }
  }

  /// At every vertex of the surface, and amid its triangles.
  void expect_enclosed() {
    const TerrainHeights truth(surface_);
    for (const int level : {0, 1, 3}) {
      EnvelopeRequest wanted;
      wanted.level = level;
      wanted.cut_by = wanted.enclosed = ThemeChoice::all();
      const Envelope envelope = envelop(*store_, wanted, progress_);
      const TerrainHeights lower(envelope.lower), upper(envelope.upper);
      double deepest = 0, highest = 0;
      const auto look_at = [&](const Position& p) {
        const auto low = lower.height_at(p), high = upper.height_at(p), z = truth.height_at(p);
        if (!low || !high || !z) return;
        deepest = std::max(deepest, *low - *z), highest = std::max(highest, *z - *high);
      };
      for (const GridPoint& v : surface_.vertices)
        if (v.x >= 0) look_at({v.x, v.y});
      for (std::size_t i = 0; i < 20000; ++i) {
        const std::array<GridPoint, 3> t =
            surface_.corners(static_cast<std::uint32_t>(random_() % surface_.triangles.size()));
        const double u = in(0, 1), w = in(0, 1) * (1 - u), v = 1 - u - w;
        look_at({static_cast<std::int32_t>(std::lround(u * t[0].x + v * t[1].x + w * t[2].x)),
                 static_cast<std::int32_t>(std::lround(u * t[0].y + v * t[1].y + w * t[2].y))});
      }
      EXPECT_LE(deepest, 1e-6) << "level " << level;
      EXPECT_LE(highest, 1e-6) << "level " << level;
    }
  }

  static std::size_t wrong_cells(const Result& certain, const Result& truth) {
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < truth.visible.size(); ++i)
      wrong += certain.visible[i] != Verdict::kUndecided && certain.visible[i] != truth.visible[i] ? 1 : 0;
    return wrong;
  }

  /// Blocks of coarse levels. Returns how many cells they are certain of.
  std::size_t expect_blocks_right() {
    std::size_t certain = 0;
    for (const bool on_surface : {false, true}) {
      Request request;
      request.observers = {{"o", anywhere(), 3}};
      request.target_height = 2;
      request.nodata = NoData::kClear;
      request.themes = ThemeChoice::all();
      request.observers_on_surface = request.targets_on_surface = on_surface;
      request.grid = RasterGrid::aligned(area_, std::max(area_.width(), area_.height()) / 150);
      const Result truth = test::compute_at_full_detail(*store_, request, {}, progress_).result;
      for (const double tolerance : {0.5, 2.0, 8.0}) {
        request.detail = Detail::tolerance(tolerance);
        const Result result = certify_by_blocks(*store_, request, {}, progress_).result;
        certain += result.cells.hidden + result.cells.visible;
        EXPECT_EQ(wrong_cells(result, truth), 0U) << tolerance << " m, on the surface: " << on_surface;
      }
    }
    return certain;
  }

  /// Turbines that stand anywhere, of which the ground hides some.
  void expect_zone_right() {
    ZoneRequest request;
    while (turbines_.size() < 4) turbines_.push_back(anywhere());
    for (std::size_t k = 0; k < turbines_.size(); ++k) {
      Turbine t;
      t.number = k + 1, t.position = turbines_[k], t.tip_height = k == 0 ? 12 : in(10, 40), t.hub_height = 10;
      t.radius = 0.7 * std::max(area_.width(), area_.height());
      request.turbines.push_back(t);
    }
    request.grid = RasterGrid::aligned(area_, std::max(area_.width(), area_.height()) / 150);
    request.themes = ThemeChoice::all();
    request.nodata = random_() % 2 == 0 ? NoData::kUnknown : NoData::kBlock;
    const Zone pruned = survey_turbines(*store_, request, progress_);
    const Zone whole = survey_turbines(ground_, &surface_, request, progress_);
    test::expect_same(pruned.bare, whole.bare);
    test::expect_same(*pruned.screened, *whole.screened);
    EXPECT_EQ(pruned.statistics.lines, whole.statistics.lines);
  }

  /// No candidate that bounds drop is one that brute force chooses. `memory` is less than the surface takes.
  void expect_sites_right(std::uint64_t memory) {
    SiteSurvey survey;
    survey.themes = ThemeChoice::all();
    survey.radius = std::max(area_.width(), area_.height()) / 6;
    survey.targets.height = 1.5;
    survey.memory_bytes = memory;
    for (int i = 0; i < 10; ++i) {
      const Point2 p = anywhere();
      survey.positions.push_back({std::to_string(i), p, 4, *height_on(ground_, p)});
    }
    survey.targets.grid = grid_of_reach(*store_, survey.positions, survey.radius, survey.radius / 16);
    test::expect_choice(*store_, survey, test::exact_coverage(*store_, survey), 3);
  }

  void expect_nothing_wrong(std::uint64_t memory_of_sites) {
    expect_enclosed();
    EXPECT_GT(expect_blocks_right(), 0U);
    expect_zone_right();
    expect_sites_right(memory_of_sites);
  }

  test::TemporaryDirectory directory_;
  NoProgress progress_;
  std::mt19937 random_{test::seed()};
  std::optional<Store> store_;
  Tin surface_, ground_;
  Box area_;                      ///< that is looked at
  std::vector<Point2> turbines_;  ///< those that must stand somewhere
};

TEST_F(RaisedPlace, TownOfEveryKind) {
  make_town(false);
  expect_nothing_wrong(1000000);
}

TEST_F(RaisedPlace, TownThatCutsIntoTheGround) {
  make_town(true);
  expect_nothing_wrong(1000000);
}

TEST_F(RaisedPlace, Alexandria) {
  const std::string data = std::string(ITIN_SOURCE_DIR) + "/scripts/demo-data/";
  import_ground({data + "alexandria-dtm.tif"});
  import_features(data + "alexandria-buildings.geojson", ThemeKind::Buildings, "houses", "HEIGHT");
  open();
  expect_nothing_wrong(20000000);
}

TEST_F(RaisedPlace, Delft) {
  const std::string model = shared("ahn3-bgt-delft/output/testarea.json"),
                    points = shared("derived-las/ahn3_cropped_2.las");
  if (!std::filesystem::exists(model) || !std::filesystem::exists(points))
    GTEST_SKIP() << "needs " << model << " and " << points;
  import_ground({points}, "EPSG:28992", {2, 9});
  import_features(model, ThemeKind::Buildings, "houses", "", "EPSG:28992");
  open();
  expect_enclosed();
  EXPECT_GT(expect_blocks_right(), 0U);
  expect_zone_right();
}

/// The canopy in squares, each as high as it is on average there.
Features woods(const std::string& raster, int side) {
  GDALAllRegister();
  const GDALDatasetUniquePtr dataset(GDALDataset::Open(raster.c_str(), GDAL_OF_RASTER));
  std::array<double, 6> affine{};
  dataset->GetGeoTransform(affine.data());
  const int columns = dataset->GetRasterXSize() / side, rows = dataset->GetRasterYSize() / side;
  std::vector<double> z(static_cast<std::size_t>(columns * rows));
  GDALRasterIOExtraArg averaged;
  INIT_RASTERIO_EXTRA_ARG(averaged);
  averaged.eResampleAlg = GRIORA_Average;
  EXPECT_EQ(dataset->GetRasterBand(1)->RasterIO(GF_Read, 0, 0, columns * side, rows * side, z.data(), columns, rows,
                                                GDT_Float64, 0, 0, &averaged),
            CE_None);
  Features result;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const double height = z[static_cast<std::size_t>(row * columns + column)];
      const double west = affine[0] + column * side, north = affine[3] - row * side;
      if (height >= 2 && height < 100) result.push_back(test::box(west, north - side, west + side, north, height));
    }
  }
  return result;
}

TEST_F(RaisedPlace, FingleWoods) {
  const std::string data = shared("ea-vom-dartmoor-newforest/");
  if (!std::filesystem::exists(data)) GTEST_SKIP() << "needs " << data;
  import_ground({data + "tiles/sx78.zip", data + "tiles/sx79.zip"});
  add(woods(data + "fingle_woods_vom.tif", 24), ThemeKind::Vegetation, "wood");
  open();
  area_ = {273000, 88600, 275600, 91200};
  expect_nothing_wrong(1000000);
}

/// A town behind a ridge, which no one sees a turbine from.
TEST_F(RaisedPlace, GroundThatTheRidgeHidesIsReadWithoutItsFeatures) {
  test::write_raster(file("t.tif"), {kPlaceCorner.x, kPlaceCorner.y, kPlaceSide / 60, 61, 61, 27700},
                     [&](int c, int r) { return (c == 20 ? 100.0 : 0.0) + in(0, 2) + 0 * r; });
  import_ground({file("t.tif")});
  Features houses;
  for (int i = 0; i < 30; ++i)
    for (int k = 0; k < 30; ++k)
      houses.push_back(test::box(kPlaceCorner.x + 350 + 15 * i, kPlaceCorner.y - 50 - 25 * k,
                                 kPlaceCorner.x + 360 + 15 * i, kPlaceCorner.y - 40 - 25 * k, 4));
  add(houses, ThemeKind::Buildings, "houses");
  open();
  ZoneRequest request;
  Turbine t;
  t.position = {kPlaceCorner.x + 150, kPlaceCorner.y - 450}, t.tip_height = 40, t.radius = 1000;
  request.turbines = {t};
  request.grid = RasterGrid::aligned(area_, 5);
  request.themes = ThemeChoice::all();
  const Zone pruned = survey_turbines(*store_, request, progress_);
  const Zone whole = survey_turbines(ground_, &surface_, request, progress_);
  test::expect_same(*pruned.screened, *whole.screened);
  EXPECT_LT(pruned.statistics.triangles, ground_.triangles.size() + surface_.triangles.size() / 2);
}

}  // namespace
}  // namespace itin::viewshed
