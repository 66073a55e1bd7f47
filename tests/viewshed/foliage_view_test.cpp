// Viewsheds through woods: each cell is what a line of sight to it says, small steps along lines agree, and what must
// hold of any wood does.
#include <algorithm>
#include <atomic>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <random>

#include <fmt/format.h>
#include <gdal_priv.h>
#include <gtest/gtest.h>

#include <itin/error.hpp>
#include <itin/feature_at.hpp>
#include <itin/import.hpp>
#include <itin/store.hpp>
#include <itin/triangulate.hpp>
#include <profile/foliage.hpp>
#include <viewshed/foliage_view.hpp>

#include "line/cell_tiles.hpp"
#include "support/rolling_hill.hpp"

namespace itin::viewshed {
namespace {

using profile::Foliage;
using profile::FoliageSight;
using profile::SightVerdict;

/// 60 x 60 posts every 10 m from (300000, 199400), with woods that have leaf areas of their own, and houses.
class FoliageViews : public test::RollingHill {
 protected:
  /// Woods of random size on whole metres, so that lines to cells run along their edges, too.
  void add_woods(const std::string& theme, int count, double west = 300010, double east = 300480) {
    std::vector<test::LineFeature> woods;
    for (int i = 0; i < count; ++i) {
      const double x = whole(west, east), y = whole(199420, 199900);
      woods.push_back(test::box(x, y, x + whole(10, 90), y + whole(10, 90), in(4, 15)));
      woods.back().properties = fmt::format(R"({{"h":{:.2f},"lad":{:.2f}}})", in(4, 15), in(0, 0.05));
    }
    import_woods(theme, woods);
  }
  double whole(double low, double high) { return std::round(in(low, high)); }

  Request request(int observers = 1) {
    Request request;
    for (int i = 0; i < observers; ++i)
      request.observers.push_back({.name = std::to_string(i),
                                   .position = {whole(300050, 300550) + 0.5, whole(199450, 199950) + 0.5},
                                   .height = in(2, 25)});
    request.target_height = in(0, 3);
    request.cell_size = 10;
    request.themes = ThemeChoice::all();
    return request;
  }
  ThroughFoliage seen(const Store& store, const Request& request, const Foliage& foliage,
                      std::uint64_t memory = std::uint64_t{1} << 30) {
    return compute_through_foliage(store, request, foliage, {.memory_bytes = memory}, progress_);
  }

  FoliageSight line_to(const Store& store, const Result& result, std::size_t cell, const Foliage& foliage) const {
    const Observer& observer = result.request.observers.front();
    const auto columns = static_cast<std::size_t>(result.grid.columns());
    const Point2 to =
        result.grid.centre(static_cast<std::int64_t>(cell % columns), static_cast<std::int64_t>(cell / columns));
    profile::LosQuery query;
    query.from_height_m = observer.height, query.to_height_m = result.request.target_height;
    query.from_on_surface = result.request.observers_on_surface,
    query.to_on_surface = result.request.targets_on_surface;
    query.earth = result.request.earth;
    return profile::through_foliage(
        store, {.from = observer.position, .to = to, .detail = result.request.detail, .themes = result.request.themes},
        query, foliage);
  }

  /// Asks some cells again as lines of sight, and returns how many of them look through foliage. Also asks all cells of
  /// the observer's own column, row and diagonals, to which lines run along edges.
  int ask_again(const Store& store, const ThroughFoliage& seen, const Foliage& foliage, int wanted) {
    const Result& result = seen.computed.result;
    const auto columns = static_cast<std::size_t>(result.grid.columns());
    const auto own = result.grid.cell_at(result.request.observers.front().position).value();
    std::vector<std::size_t> cells;
    for (int i = 0; i < wanted; ++i) cells.push_back(random_() % result.visible.size());
    for (std::size_t c = 0; c < result.visible.size(); ++c) {
      const auto right = static_cast<std::int64_t>(c % columns) - own.column;
      const auto down = static_cast<std::int64_t>(c / columns) - own.row;
      if (right == 0 || down == 0 || std::abs(right) == std::abs(down)) cells.push_back(c);
    }
    int through = 0;
    for (const std::size_t cell : cells) {
      if (result.visible[cell] == Verdict::kOutside) continue;
      const FoliageSight line = line_to(store, result, cell, foliage);
      // At a tolerance a line of sight is undecided where it is nearer to the ground than that.
      const bool undecided = line.solid.verdict == SightVerdict::kUndecided;
      if (undecided && result.visible[cell] == Verdict::kHidden) continue;
      if (!undecided) {
        EXPECT_EQ(result.visible[cell] == Verdict::kVisible, line.verdict == SightVerdict::kVisible) << cell;
      }
      if (line.solid.verdict == SightVerdict::kHidden) {
        EXPECT_EQ(seen.foliage.transmittance[cell], 0) << cell;
        EXPECT_TRUE(std::isnan(seen.foliage.length_m[cell])) << cell;
        continue;
      }
      EXPECT_NEAR(seen.foliage.length_m[cell], line.length_m, 1e-4 + 1e-6 * line.length_m) << cell;
      EXPECT_NEAR(seen.foliage.transmittance[cell], line.transmittance, 1e-5) << cell;
      through += line.length_m > 1 ? 1 : 0;
    }
    return through;
  }
};

TEST_F(FoliageViews, AreWhatLinesOfSightSay) {
  add_woods("woods", 12);
  add_houses();
  const Store store(path());
  const Foliage sparse{.leaf_area = 0.02};
  int through = 0;
  for (int i = 0; i < 4; ++i) {
    Request asked = request();
    asked.observers_on_surface = i == 1, asked.targets_on_surface = i == 2;
    if (i == 3) asked.detail = Detail::tolerance(2);
    through += ask_again(store, seen(store, asked, sparse), sparse, 100);
  }
  EXPECT_GT(through, 20);
}

/// Woods whose edges lie on rows and columns of cell centres, some side by side, and some of another theme.
TEST_F(FoliageViews, RunAlongEdgesAsLinesOfSightDo) {
  const auto centre = [&](double low, double high) { return 10 * std::floor(in(low, high) / 10) + 5; };
  for (const std::string theme : {"woods", "copses"}) {
    std::vector<test::LineFeature> woods;
    for (int i = 0; i < 8; ++i) {
      const double x = centre(300020, 300450), y = centre(199420, 199850), side = 10 * std::round(in(2, 6));
      for (const double beside : {0.0, side}) {
        woods.push_back(test::box(x + beside, y, x + beside + side, y + side, in(4, 15)));
        woods.back().properties = fmt::format(R"({{"h":{:.2f},"lad":0.02}})", in(4, 15));
      }
    }
    import_woods(theme, woods);
  }
  const Store store(path());
  int through = 0;
  for (int i = 0; i < 3; ++i) {
    Request asked = request();
    asked.observers.front().position = {centre(300050, 300550), centre(199450, 199950)};
    for (const Foliage& foliage : {Foliage{.leaf_area = 0.02}, Foliage{.leaf_area_field = "lad"}})
      through += ask_again(store, seen(store, asked, foliage), foliage, 10);
  }
  EXPECT_GT(through, 20);
}

TEST_F(FoliageViews, TakeLeafAreasOfFeaturesAsLinesOfSightDo) {
  add_woods("woods", 24);
  const Store store(path());
  const Foliage by_field{.leaf_area_field = "lad"};
  EXPECT_GT(ask_again(store, seen(store, request(), by_field), by_field, 100), 5);
}

TEST_F(FoliageViews, EqualManySmallSteps) {
  add_woods("woods", 12);
  add_houses();
  const Store store(path());
  const Request asked = request();
  const ThroughFoliage view = seen(store, asked, {.leaf_area = 0.02});
  const Result& result = view.computed.result;
  const Observer& eye = asked.observers.front();
  int through = 0;
  for (int i = 0; i < 2000 && through < 10; ++i) {
    const std::size_t cell = random_() % result.visible.size();
    if (!(view.foliage.length_m[cell] > 0)) continue;
    const auto columns = static_cast<std::size_t>(result.grid.columns());
    const Point2 to =
        result.grid.centre(static_cast<std::int64_t>(cell % columns), static_cast<std::int64_t>(cell / columns));
    constexpr int kSteps = 10000;
    std::vector<Point2> places{to, eye.position};
    for (int k = 0; k < kSteps; ++k) {
      const double t = (k + 0.5) / kSteps;
      places.push_back({eye.position.x + t * (to.x - eye.position.x), eye.position.y + t * (to.y - eye.position.y)});
    }
    const auto full = Detail::tolerance(0);
    const auto tops = heights_at(store, places, full, ThemeChoice::all(), progress_),
               solid = heights_at(store, places, full, ThemeChoice::parse("houses"), progress_),
               bare = heights_at(store, {to, eye.position}, full, ThemeChoice::none(), progress_);
    const double from = *bare[1] + eye.height, end = *bare[0] + asked.target_height;
    const double length = std::hypot(to.x - eye.position.x, to.y - eye.position.y),
                 bulge = asked.earth.drop_coefficient() * length * length;
    double within = 0;
    for (std::size_t k = 0; k < kSteps; ++k) {
      const double t = (static_cast<double>(k) + 0.5) / kSteps, ray = from + t * (end - from) - bulge * t * (1 - t);
      if (ray < *tops[k + 2] && *tops[k + 2] > *solid[k + 2] + 0.05) within += std::hypot(length, end - from) / kSteps;
    }
    EXPECT_NEAR(view.foliage.length_m[cell], within, 1 + length / 500) << cell;
    EXPECT_NEAR(view.foliage.transmittance[cell], std::exp(-0.5 * 0.02 * view.foliage.length_m[cell]), 1e-5);
    ++through;
  }
  EXPECT_GT(through, 1);
}

// Where woods overlap, one of them has the place, and it may be the lower one: more wood stands beside the first.
TEST_F(FoliageViews, LoseLightToMoreWoodAndGainItByFelling) {
  add_woods("first", 8, 300010, 300180);
  add_houses();
  const Request asked = request();
  const Foliage sparse{.leaf_area = 0.02};
  ThroughFoliage before;
  {
    const Store store(path());
    before = seen(store, asked, sparse);
  }
  // So many that some cells lose light, whatever the seed.
  add_woods("second", 24, 300290, 300480);
  const Store store(path());
  const std::vector<FeatureNumber> all = woods_of(store), some = with_even_numbers(all);
  const ThroughFoliage more = seen(store, asked, sparse);
  Request felled = asked, cleared = asked;
  felled.themes = without_features(store, ThemeChoice::all(), some, progress_);
  cleared.themes = without_features(store, ThemeChoice::all(), all, progress_);
  const ThroughFoliage less = seen(store, felled, sparse), none = seen(store, cleared, sparse);
  const Result open = compute(store, cleared, progress_);
  EXPECT_EQ(none.computed.result.visible, open.visible);
  int lost = 0, gained = 0;
  for (std::size_t cell = 0; cell < open.visible.size(); ++cell) {
    const float light = more.foliage.transmittance[cell];
    if (std::isnan(light)) continue;
    EXPECT_LE(light, before.foliage.transmittance[cell] + 1e-3) << cell;
    EXPECT_GE(less.foliage.transmittance[cell], light - 1e-3) << cell;
    EXPECT_TRUE(none.foliage.length_m[cell] == 0 || std::isnan(none.foliage.length_m[cell])) << cell;
    lost += light < before.foliage.transmittance[cell] - 0.01 ? 1 : 0;
    gained += light < less.foliage.transmittance[cell] - 0.01 ? 1 : 0;
  }
  EXPECT_GT(lost, 0);
  EXPECT_GT(gained, 0);
}

/// Two rasters are equal also where both have no value.
void expect_equal(const std::vector<float>& a, const std::vector<float>& b, double tolerance) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    ASSERT_EQ(std::isnan(a[i]), std::isnan(b[i])) << i;
    if (std::isnan(a[i])) continue;
    ASSERT_NEAR(a[i], b[i], tolerance) << i;
  }
}

TEST_F(FoliageViews, DoNotDependOnTheMemory) {
  add_woods("woods", 12);
  add_houses();
  const Store store(path());
  const Request asked = request(2);
  const Foliage sparse{.leaf_area = 0.02};
  const ThroughFoliage whole = seen(store, asked, sparse), parts = seen(store, asked, sparse, 1000000);
  EXPECT_TRUE(whole.computed.whole);
  EXPECT_FALSE(parts.computed.whole);
  EXPECT_EQ(whole.computed.result.visible, parts.computed.result.visible);
  expect_equal(whole.foliage.length_m, parts.foliage.length_m, 1e-4);
  expect_equal(whole.foliage.transmittance, parts.foliage.transmittance, 1e-6);
}

TEST_F(FoliageViews, HaveTheLightOfTheBestObserver) {
  add_woods("woods", 12);
  const Store store(path());
  const Request asked = request(3);
  const Foliage sparse{.leaf_area = 0.02};
  const ThroughFoliage all = seen(store, asked, sparse);
  std::vector<float> best(all.computed.result.visible.size(), NAN);
  std::vector<bool> visible(best.size());
  for (std::size_t i = 0; i < asked.observers.size(); ++i) {
    const ThroughFoliage one = seen(store, request_for_observer(all.computed.result, i), sparse);
    for (std::size_t cell = 0; cell < best.size(); ++cell) {
      best[cell] = std::fmax(best[cell], one.foliage.transmittance[cell]);
      if (one.computed.result.visible[cell] == Verdict::kVisible) visible[cell] = true;
    }
  }
  expect_equal(all.foliage.transmittance, best, 0);
  for (std::size_t cell = 0; cell < best.size(); ++cell)
    EXPECT_EQ(all.computed.result.visible[cell] == Verdict::kVisible, visible[cell]);
}

TEST_F(FoliageViews, AreThoseWithoutFoliageWhereNoLightIsLost) {
  add_woods("woods", 6);
  add_houses();
  const Store store(path());
  Request asked = request();
  const ThroughFoliage clear = seen(store, asked, {.leaf_area = 0}),
                       all = seen(store, asked, {.least_transmittance = 1});
  Request bare = asked;
  bare.themes = ThemeChoice::parse("houses");
  EXPECT_EQ(clear.computed.result.visible, compute(store, bare, progress_).visible);
  EXPECT_EQ(all.computed.result.visible, compute(store, asked, progress_).visible);
  asked.mode = Mode::kAngle;
  EXPECT_THROW(seen(store, asked, {}), InputError);
}

TEST_F(FoliageViews, RefuseAWrongFieldBeforeTheyAreComputed) {
  struct Counting final : Progress {
    std::atomic<int> reports = 0;
    void report(std::string_view, double) override { ++reports; }
  } counting;
  add_woods("woods", 2);
  const Store store(path());
  EXPECT_THROW(compute_through_foliage(store, request(), {.leaf_area_field = "none"}, {}, counting), InputError);
  EXPECT_EQ(counting.reports, 0);
}

// Real woods.

std::string data_file(const std::string& name) {
  return std::string(ITIN_DATA_DIR) + "/" + name;
}

/// A part of a canopy raster of 1 m with OS Terrain 50 beneath; returns its middle.
Point2 import_canopy(const std::string& store, const test::TemporaryDirectory& directory, const std::string& tile,
                     const std::string& canopy) {
  ImportOptions options;
  std::string upper = tile;
  std::transform(upper.begin(), upper.end(), upper.begin(), [](char c) { return static_cast<char>(std::toupper(c)); });
  const std::string folder = data_file("ea-vom-dartmoor-newforest/");
  options.sources = {"/vsizip/" + folder + "tiles/" + tile + ".zip/" + upper + ".asc"};
  options.crs = "EPSG:27700";
  NoProgress progress;
  import_terrain(store, options, progress);
  constexpr int kPart = 120, kFirst = 240;
  GDALAllRegister();
  const GDALDatasetUniquePtr raster(GDALDataset::Open((folder + canopy).c_str()));
  double transform[6];
  raster->GetGeoTransform(transform);
  std::vector<double> metres(kPart * kPart);
  if (raster->GetRasterBand(1)->RasterIO(GF_Read, kFirst, kFirst, kPart, kPart, metres.data(), kPart, kPart,
                                         GDT_Float64, 0, 0) != CE_None)
    throw Error("cannot read " + canopy);
  const double xmin = transform[0] + kFirst, ymax = transform[3] - kFirst;
  test::write_raster(directory.file("canopy.tif"), {xmin, ymax, 1, kPart, kPart, 27700}, [&](int c, int r) {
    const double height = metres[static_cast<std::size_t>(r * kPart + c)];
    return height > 0 && height < 60 ? height : 0;
  });
  ImportOptions woods;
  woods.sources = {directory.file("canopy.tif")};
  woods.kind = ThemeKind::Vegetation, woods.theme = "canopy";
  import_lines(store, woods, progress);
  return {xmin + kPart / 2.0, ymax - kPart / 2.0};
}

/// The lidar of a part of Delft with the outlines of its greenery, 6 m high; returns a place in it.
Point2 import_delft(const std::string& store) {
  ImportOptions options;
  options.sources = {data_file("derived-las/ahn3_cropped_2.las")};
  options.classes = {2, 9};
  options.crs = "EPSG:7415", options.to_crs = "EPSG:28992";
  NoProgress progress;
  import_terrain(store, options, progress);
  ImportOptions woods;
  woods.sources = {data_file("ahn3-bgt-delft/bgt/bgt_begroeidterreindeel.sqlite")};
  woods.kind = ThemeKind::Vegetation, woods.theme = "green", woods.height = 6;
  import_lines(store, woods, progress);
  return middle_of(Store(store).metadata().grid.box(Store(store).metadata().bounds));
}

class RealWoods : public FoliageViews {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(data_file("README.md"))) GTEST_SKIP() << ITIN_DATA_DIR << " is absent";
  }
  void expect_agreement(Point2 place) {
    const Store store(path());
    const Foliage winter{.leaf_area = profile::kLeavesOff};
    int through = 0;
    for (const double height : {3.0, 20.0}) {
      Request asked;
      asked.observers = {{.name = "mast", .position = place, .height = height}};
      asked.target_height = 1.5, asked.radius = 100, asked.cell_size = 2, asked.themes = ThemeChoice::all();
      through += ask_again(store, seen(store, asked, winter), winter, 100);
    }
    EXPECT_GT(through, 50);
  }
};

TEST_F(RealWoods, OfDartmoorAreWhatLinesOfSightSay) {
  expect_agreement(import_canopy(path(), directory_, "sx78", "fingle_woods_vom.tif"));
}
TEST_F(RealWoods, OfTheNewForestAreWhatLinesOfSightSay) {
  expect_agreement(import_canopy(path(), directory_, "su20", "new_forest_vom.tif"));
}
TEST_F(RealWoods, OfDelftAreWhatLinesOfSightSay) {
  expect_agreement(import_delft(path()));
}

}  // namespace
}  // namespace itin::viewshed
