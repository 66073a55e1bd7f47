// Precise and certified viewsheds over a surface with buildings and trees, against the walk over every triangle of it.
#include <cmath>
#include <iostream>
#include <random>

#include <gtest/gtest.h>

#include <itin/import.hpp>
#include <itin/triangulate.hpp>
#include <viewshed/viewshed.hpp>

#include "certify/level_source.hpp"
#include "support/brute_force_viewshed.hpp"
#include "support/full_detail.hpp"
#include "support/raster_file.hpp"
#include "support/seed.hpp"
#include "support/temporary_directory.hpp"
#include "support/terrain_tin.hpp"
#include "support/vector_file.hpp"

namespace itin::viewshed {
namespace {

constexpr int kTownSide = 40;
constexpr double kTownStep = 25;
constexpr std::uint64_t kLittleMemory = 160000;                          ///< less than the town takes
constexpr Point2 kTownCorner{300000, 200000}, kEye{300437.3, 199487.1};  // nothing stands on the eye

/// Fractal hills with houses turned every way, and a wood.
class RaisedCertified : public testing::Test {
 protected:
  void make(double void_radius = 0, int side = kTownSide, std::uint32_t seed = test::seed()) {
    make_hills(void_radius, side, seed);
    std::mt19937 random(seed);
    add(boxes(random, 60, {8, 30}, {4, 25}), ThemeKind::Buildings, "houses");
    add({box(random, 100, 150, 12, 18), box(random, 60, 90, 8, 10)}, ThemeKind::Vegetation, "wood");
    open();
  }

  /// A ridge that a low house cuts through, with others about it.
  void make_cuts() {
    make_hills(0, kTownSide, test::seed(), 3, [](int row) { return row == 10 ? 20.0 : 0.0; });
    std::mt19937 random(test::seed());
    std::vector<test::LineFeature> low = boxes(random, 6, {20, 60}, {0.3, 1});
    low.push_back(test::box(300390, 199690, 300490, 199785, 0.5));
    add(low, ThemeKind::Buildings, "low", Foundation::flat);
    add(boxes(random, 10, {8, 30}, {4, 12}), ThemeKind::Buildings, "high", Foundation::flat);
    add(boxes(random, 20, {8, 30}, {4, 12}), ThemeKind::Buildings, "on_walls");
    open();
  }

  void make_hills(
      double void_radius, int side, std::uint32_t seed, double relief = 60,
      double (*ridge)(int row) = [](int) { return 0.0; }) {
    const int posts = side < 65 ? 65 : 257;
    const std::vector<double> z = test::fractal_heights(posts, relief, 0.5, seed);
    test::write_raster(directory_.file("t.tif"), {kTownCorner.x, kTownCorner.y, kTownStep, side, side, 27700},
                       [&](int c, int r) {
                         if (std::hypot(c - 30, r - 30) < void_radius) return std::nan("");
                         return z[static_cast<std::size_t>(r * posts + c)] + ridge(r);
                       });
    ImportOptions options;
    options.sources = {directory_.file("t.tif")};
    NoProgress progress;
    import_terrain(path(), options, progress);
  }

  void open() {
    NoProgress progress;
    store_.emplace(path());
    surface_ = triangulate(*store_, Window::all(), Detail::tolerance(0), progress, ThemeChoice::all());
    ground_ = triangulate(*store_, Window::all(), Detail::tolerance(0), progress);
    ASSERT_FALSE(surface_.raised_theme.empty());
  }

  std::string path() { return directory_.file("s.itin"); }

  struct Extent {
    double least, most;
  };
  static std::vector<test::LineFeature> boxes(std::mt19937& random, int count, Extent size, Extent height) {
    std::vector<test::LineFeature> result;
    for (int i = 0; i < count; ++i) result.push_back(box(random, size.least, size.most, height.least, height.most));
    return result;
  }

  static test::LineFeature box(std::mt19937& random, double least, double most, double low, double high) {
    std::uniform_real_distribution<double> place(120, kTownSide * kTownStep - 120), size(least, most),
        height(low, high);
    double x = kEye.x, y = kEye.y;
    while (std::hypot(x - kEye.x, y - kEye.y) < most)
      x = kTownCorner.x + place(random), y = kTownCorner.y - place(random);
    const double width = size(random), depth = size(random), turn = place(random);
    return test::turned_box({x, y}, width, depth, turn, height(random));
  }

  void add(const std::vector<test::LineFeature>& features, ThemeKind kind, const std::string& name,
           std::optional<Foundation> foundation = std::nullopt) {
    test::write_lines(directory_.file(name + ".geojson"), features, true);
    ImportOptions options;
    options.sources = {directory_.file(name + ".geojson")};
    options.kind = kind;
    options.theme = name;
    options.height_field = "h";
    options.foundation = foundation;
    NoProgress progress;
    import_lines(path(), options, progress);
  }

  Request request(double height, double target, bool eye_on_surface, bool target_on_surface) const {
    Request r = test::look(kEye, height, target, 17);
    r.themes = ThemeChoice::all();
    r.observers_on_surface = eye_on_surface;
    r.targets_on_surface = target_on_surface;
    return r;
  }

  /// Everything at once, and in segments.
  void expect_exact(const Request& r) {
    NoProgress progress;
    const RasterGrid cells = compute(*store_, r, progress).grid;
    const std::vector<Verdict> truth = test::brute_force(surface_, ground_, r, cells);
    for (const std::uint64_t memory : {std::uint64_t{1} << 30, kLittleMemory}) {
      const Result result = test::compute_at_full_detail(*store_, r, {.memory_bytes = memory}, progress).result;
      ASSERT_EQ(result.visible.size(), truth.size());
      std::uint64_t different = 0;
      for (std::size_t i = 0; i < truth.size(); ++i) different += result.visible[i] != truth[i];
      EXPECT_EQ(different, 0U) << "memory " << memory;
      EXPECT_GT(result.cells.visible, 0U);
      EXPECT_GT(result.cells.hidden, 0U);
    }
  }

  /// By blocks of coarse levels; 2 m is certain that more than one cell in so many is hidden.
  void expect_never_wrong(bool on_surface, std::optional<std::size_t> share_hidden = std::nullopt) {
    NoProgress progress;
    Request r = request(3, 2, on_surface, on_surface);
    r.observers.front().radius = 2000;
    const std::vector<Verdict> truth = test::brute_force(surface_, ground_, r, compute(*store_, r, progress).grid);
    for (const double tolerance : {2.0, 8.0, 32.0}) {
      r.detail = Detail::tolerance(tolerance);
      const Result result = certify_by_blocks(*store_, r, {}, progress).result;
      EXPECT_GT(result.cells.undecided, 0U);
      if (share_hidden && !on_surface && tolerance == 2) {
        EXPECT_GT(result.cells.hidden, truth.size() / *share_hidden);
      }
      for (std::size_t i = 0; i < truth.size(); ++i)
        if (result.visible[i] != Verdict::kUndecided) {
          ASSERT_EQ(result.visible[i], truth[i]) << i << " at " << tolerance;
        }
    }
  }

  test::TemporaryDirectory directory_;
  std::optional<Store> store_;
  Tin surface_, ground_;
};

TEST_F(RaisedCertified, PreciseIsTheWalkOverEveryTriangle) {
  make();
  for (const double target : {0.0, 2.0}) {
    expect_exact(request(3, target, false, false));
    expect_exact(request(25, target, true, true));
  }
  Request part = request(3, 2, false, false);
  part.radius = 300;
  part.azimuth = AngleRange{300, 100};
  expect_exact(part);
  part.themes = ThemeChoice::parse("wood");
  NoProgress progress;
  surface_ = triangulate(*store_, Window::all(), Detail::tolerance(0), progress, part.themes);
  expect_exact(part);
}

TEST_F(RaisedCertified, PreciseAcrossVoids) {
  make(6);
  expect_exact(request(30, 2, false, false));
}

/// Angles need all ground under every line; ground that cannot change what is visible is not read for it.
TEST_F(RaisedCertified, PreciseReadsNoGroundThatDecidesNothing) {
  constexpr std::uint32_t kEyeAmongHills = 7;  // from a top much more is open
  make(0, 256, kEyeAmongHills);
  NoProgress progress;
  Request r = request(3, 2, false, false);
  const auto over = [&](Mode mode, std::uint64_t memory) {
    r.mode = mode;
    return test::compute_at_full_detail(*store_, r, {.memory_bytes = memory}, progress).result;
  };
  constexpr std::uint64_t kFewMegabytes = 6 << 20;
  const Result result = over(Mode::kVisible, kFewMegabytes);
  EXPECT_LT(result.statistics.retrieval.points_read,
            over(Mode::kAngle, kFewMegabytes).statistics.retrieval.points_read * 3 / 4);
  EXPECT_EQ(result.visible, over(Mode::kVisible, 1 << 30).visible);
}

TEST_F(RaisedCertified, EveryCellIsCertain) {
  make();
  Request r = request(3, 2, false, false);
  NoProgress progress;
  r.nodata = NoData::kUnknown;
  const std::vector<Verdict> truth = test::brute_force(surface_, ground_, r, compute(*store_, r, progress).grid);
  const Result result = compute_certified(*store_, r, {}, progress).result;
  EXPECT_EQ(result.cells.undecided, 0U);
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const Verdict certain = truth[i] == Verdict::kVisible  ? Verdict::kVisible
                            : truth[i] == Verdict::kHidden ? Verdict::kHidden
                                                           : Verdict::kOutside;
    ASSERT_EQ(result.visible[i], certain) << i;
  }
}

/// Coarse levels know nothing of features; these hide more, and targets may stand on them.
TEST_F(RaisedCertified, CoarseLevelsAreNeverWrongAboutFeatures) {
  make();
  for (const bool on_surface : {false, true}) expect_never_wrong(on_surface, 50);
}

/// Ground that foundations cut away shows what it hid.
TEST_F(RaisedCertified, CoarseLevelsAreNeverWrongAboutCuts) {
  make_cuts();
  NoProgress progress;
  Request r = request(3, 2, false, false);
  const RasterGrid cells = compute(*store_, r, progress).grid;
  const std::vector<Verdict> truth = test::brute_force(surface_, ground_, r, cells);
  const std::vector<Verdict> bare = test::brute_force(ground_, ground_, r, cells);
  std::size_t revealed = 0;
  for (std::size_t i = 0; i < truth.size(); ++i)
    revealed += truth[i] == Verdict::kVisible && bare[i] == Verdict::kHidden ? 1 : 0;
  EXPECT_GT(revealed, 0U);
  for (const bool on_surface : {false, true}) expect_never_wrong(on_surface);
}

TEST_F(RaisedCertified, PreciseSeesThroughCuts) {
  make_cuts();
  for (const double target : {0.0, 2.0}) {
    expect_exact(request(3, target, false, false));
    expect_exact(request(25, target, true, true));
  }
}

TEST_F(RaisedCertified, LinesAcrossVoidsStayOpen) {
  make(6);
  Request r = request(30, 2, false, false);
  NoProgress progress;
  const auto decide = [&](NoData rule) {
    r.nodata = rule;
    return compute_certified(*store_, r, {}, progress).result;
  };
  const Result clear = decide(NoData::kClear), block = decide(NoData::kBlock), unknown = decide(NoData::kUnknown);
  EXPECT_GT(unknown.cells.undecided, 0U);
  for (std::size_t i = 0; i < clear.visible.size(); ++i) {
    if (unknown.visible[i] == Verdict::kUndecided) {
      ASSERT_EQ(clear.visible[i], Verdict::kVisible);
      ASSERT_EQ(block.visible[i], Verdict::kHidden);
    } else {
      ASSERT_EQ(unknown.visible[i], clear.visible[i]);
      ASSERT_EQ(unknown.visible[i], block.visible[i]);
    }
  }
}

}  // namespace
}  // namespace itin::viewshed
