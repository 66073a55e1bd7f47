// Certified and precise viewsheds against the exact walk over every triangle of the full surface.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <random>

#include <gtest/gtest.h>

#include <itin/error.hpp>
#include <itin/grid_units.hpp>
#include <itin/import.hpp>
#include <itin/triangulate.hpp>
#include <viewshed/viewshed.hpp>

#include "certify/level_source.hpp"
#include "index/line_tester.hpp"
#include "request/eye.hpp"
#include "support/brute_force_viewshed.hpp"
#include "support/exact_line_of_sight.hpp"
#include "support/full_detail.hpp"
#include "support/raster_file.hpp"
#include "support/same_result.hpp"
#include "support/seed.hpp"
#include "support/temporary_directory.hpp"
#include "support/terrain_tin.hpp"

namespace itin::viewshed {
namespace {

using test::look;

constexpr Point2 kHillsCorner{300000, 200000};
constexpr double kHillsStep = 50;

/// A store of a few thousand posts, with all of its triangles at hand.
class Terrain {
 public:
  explicit Terrain(int side, const std::function<double(int, int)>& height) : side_(side) {
    const std::string raster = directory_.file("t.tif"), path = directory_.file("t.itin");
    test::write_raster(raster, {kHillsCorner.x, kHillsCorner.y, kHillsStep, side, side, 27700}, height);
    ImportOptions options;
    options.sources = {raster};
    NoProgress progress;
    import_terrain(path, options, progress);
    store_.emplace(path);
    full_ = triangulate(*store_, Window::all(), Detail::tolerance(0), progress);
  }

  const Store& store() const { return *store_; }
  const Tin& full() const { return full_; }
  /// In metres east and south of the north-west corner; posts lie at kHillsStep / 2 + n kHillsStep.
  Point2 at(double east, double south) const { return {kHillsCorner.x + east, kHillsCorner.y - south}; }
  double width() const { return side_ * kHillsStep; }

 private:
  test::TemporaryDirectory directory_;
  int side_;
  std::optional<Store> store_;
  Tin full_;
};

Terrain fractal(int side, double relief, std::uint32_t seed, double void_radius = 0) {
  const std::vector<double> z = test::fractal_heights(65, relief, 0.55, seed);
  return Terrain(side, [&](int c, int r) {
    if (std::hypot(c - 0.35 * side, r - 0.6 * side) < void_radius) return std::nan("");
    return z[static_cast<std::size_t>(r) * 65 + static_cast<std::size_t>(c)];
  });
}

Terrain cardiff(int side, double void_radius = 0) {
  const test::CardiffTerrain heights;
  return Terrain(side, [&](int c, int r) {
    return std::hypot(c - 0.35 * side, r - 0.6 * side) < void_radius ? std::nan("") : heights(c + 150, r + 250);
  });
}

/// What the level decides, even where the exact answer costs less.
Result certify(const Store& store, const Request& request, Progress& progress) {
  if (request.detail.coarsest() == 0) return compute_certified(store, request, {}, progress).result;
  return certify_by_blocks(store, request, {}, progress).result;
}

std::vector<Verdict> brute_force(const Terrain& terrain, const Request& request, const RasterGrid& cells) {
  return test::brute_force(terrain.full(), terrain.full(), request, cells);
}

/// No certain cell may be wrong. Returns the share decided, of the cells in view.
double expect_certain(const Terrain& terrain, Request request, double tolerance, const std::vector<Verdict>& truth) {
  request.detail = Detail::tolerance(tolerance);
  NoProgress progress;
  const Result result = certify(terrain.store(), request, progress);
  EXPECT_EQ(result.visible.size(), truth.size());
  std::uint64_t decided = 0, in_view = 0, wrong = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const Verdict value = result.visible[i];
    wrong += (value == Verdict::kVisible && truth[i] != Verdict::kVisible) ||
             (value == Verdict::kHidden && truth[i] != Verdict::kHidden) ||
             (value == Verdict::kOutside && truth[i] != Verdict::kOutside);
    in_view += value != Verdict::kOutside;
    decided += value == Verdict::kVisible || value == Verdict::kHidden;
  }
  EXPECT_EQ(wrong, 0U) << "tolerance " << tolerance;
  EXPECT_EQ(result.cells.visible + result.cells.hidden, decided);
  EXPECT_EQ(result.cells.undecided, in_view - decided);
  return in_view == 0 ? 1 : static_cast<double>(decided) / static_cast<double>(in_view);
}

void expect_precise(const Terrain& terrain, const Request& request, const std::vector<Verdict>& truth) {
  NoProgress progress;
  // By its posts; the whole at once; a coarse pass and a few segments; many segments.
  constexpr std::uint64_t kMemory[] = {1 << 30, 1 << 30, 500000, 160000};
  for (std::size_t i = 0; i < std::size(kMemory); ++i) {
    const std::uint64_t memory = kMemory[i];
    const Result result =
        test::compute_at_full_detail(terrain.store(), request, {.memory_bytes = memory, .lattices = i == 0}, progress)
            .result;
    ASSERT_EQ(result.visible.size(), truth.size());
    std::uint64_t different = 0;
    for (std::size_t k = 0; k < truth.size(); ++k) different += result.visible[k] != truth[k];
    EXPECT_EQ(different, 0U) << "memory " << memory;
  }
}

void expect_both(const Terrain& terrain, const Request& request) {
  NoProgress progress;
  const RasterGrid cells = compute(terrain.store(), request, progress).grid;
  const std::vector<Verdict> truth = brute_force(terrain, request, cells);
  for (const double tolerance : {0.0, 2.0, 8.0, 32.0}) expect_certain(terrain, request, tolerance, truth);
  expect_precise(terrain, request, truth);
}

TEST(Certified, NeverWrongOnRandomTerrain) {
  const std::uint32_t seed = test::seed();
  const Terrain terrain = fractal(49, 150, seed);
  for (const double target : {0.0, 2.0}) {
    for (const bool curved : {true, false}) {
      Request request = look(terrain.at(25 + 20 * kHillsStep, 25 + 26 * kHillsStep), 3, target, 37);  // on a post
      if (!curved) request.earth = Earth::flat();
      expect_both(terrain, request);
    }
  }
  expect_both(terrain, look(terrain.at(711.3, 1502.7), 30, 5, 40));
}

TEST(Certified, NeverWrongOnRealTerrain) {
  const Terrain terrain = cardiff(60);
  for (const double target : {0.0, 2.0}) {
    expect_both(terrain,
                look(terrain.at(25 + 30 * kHillsStep, 25 + 31 * kHillsStep), 2, target, 50));  // cells on posts
    expect_both(terrain, look(terrain.at(1404.2, 811.9), 10, target, 43));
  }
}

TEST(Certified, NeverWrongAtTheEdgeAndAcrossVoids) {
  const Terrain terrain = cardiff(50, 6);
  for (const double target : {0.0, 2.0}) {
    expect_both(terrain, look(terrain.at(25 + 10 * kHillsStep, 25), 5, target, 41));  // on the store's edge
    expect_both(terrain, look(terrain.at(1700, 1400), 5, target, 41));
  }
}

TEST(Certified, FieldsOfView) {
  const Terrain terrain = fractal(40, 120, test::seed());
  Request request = look(terrain.at(980, 1015), 4, 2, 31);
  request.radius = 700;
  request.min_radius = 120;
  request.azimuth = AngleRange{300, 110};
  request.elevation = AngleRange{-6, 1.5};
  expect_both(terrain, request);
}

TEST(Certified, DecidesMoreAtFinerTolerances) {
  const Terrain terrain = cardiff(60);
  const Request request = look(terrain.at(1404.2, 811.9), 10, 2, 43);
  NoProgress progress;
  const std::vector<Verdict> truth = brute_force(terrain, request, compute(terrain.store(), request, progress).grid);
  const double fine = expect_certain(terrain, request, 0, truth), middle = expect_certain(terrain, request, 1, truth),
               coarse = expect_certain(terrain, request, 16, truth);
  EXPECT_GT(fine, 0.995);
  EXPECT_GT(middle, 0.5);
  EXPECT_GE(fine, middle);
  EXPECT_GE(middle, coarse);
}

TEST(Certified, UnknownVoidsLeaveLinesUndecided) {
  const Terrain terrain = cardiff(50, 6);
  Request request = look(terrain.at(1700, 1400), 200, 2, 41);
  NoProgress progress;
  const Result clear = certify(terrain.store(), request, progress);
  request.nodata = NoData::kUnknown;
  const Result unknown = certify(terrain.store(), request, progress);
  request.nodata = NoData::kBlock;
  const Result block = certify(terrain.store(), request, progress);
  EXPECT_GT(unknown.cells.undecided, clear.cells.undecided);
  EXPECT_GT(block.cells.hidden, clear.cells.hidden);
  for (std::size_t i = 0; i < clear.visible.size(); ++i) {
    if (unknown.visible[i] == Verdict::kVisible) {
      EXPECT_EQ(block.visible[i], Verdict::kVisible);
    }
    if (unknown.visible[i] == Verdict::kVisible) {
      EXPECT_EQ(clear.visible[i], Verdict::kVisible);
    }
  }
}

TEST(Certified, RingsAndSeveralObservers) {
  const Terrain terrain = cardiff(60);
  const Request first = look(terrain.at(1404.2, 811.9), 10, 2, 43), second = look(terrain.at(700, 2200), 5, 2, 43);
  NoProgress progress;
  Request request = first;
  request.detail = Detail::rings(first.observers[0].position, {{600, 0}, {1500, 0.5}, {9000, 4}});
  const Result rings = certify(terrain.store(), request, progress);
  const auto truth = brute_force(terrain, first, rings.grid), other = brute_force(terrain, second, rings.grid);
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (rings.visible[i] == Verdict::kVisible) {
      ASSERT_EQ(truth[i], Verdict::kVisible);
    }
    if (rings.visible[i] == Verdict::kHidden) {
      ASSERT_EQ(truth[i], Verdict::kHidden);
    }
  }
  request = first;
  request.observers.push_back(second.observers[0]);
  request.detail = Detail::tolerance(1);
  const Result both = certify(terrain.store(), request, progress);
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const bool seen = truth[i] == Verdict::kVisible || other[i] == Verdict::kVisible;
    if (both.visible[i] == Verdict::kVisible) {
      ASSERT_TRUE(seen);
    }
    if (both.visible[i] == Verdict::kHidden) {
      ASSERT_FALSE(seen);
    }
  }
  request.mode = Mode::kCount;
  const Result count =
      test::compute_at_full_detail(terrain.store(), request, {.memory_bytes = 500000, .lattices = false}, progress)
          .result;
  request.mode = Mode::kVisible;
  const Result any =
      test::compute_at_full_detail(terrain.store(), request, {.memory_bytes = 500000, .lattices = false}, progress)
          .result;
  request.mode = Mode::kWhich;
  const Result which =
      test::compute_at_full_detail(terrain.store(), request, {.memory_bytes = 500000, .lattices = false}, progress)
          .result;
  request.mode = Mode::kNearest;
  const Result nearest =
      test::compute_at_full_detail(terrain.store(), request, {.memory_bytes = 500000, .lattices = false}, progress)
          .result;
  const auto distance = [&](std::size_t observer, std::size_t i) {
    const auto columns = nearest.grid.columns();
    const Point2 c =
        nearest.grid.centre(static_cast<std::int64_t>(i) % columns, static_cast<std::int64_t>(i) / columns);
    const Point2 o = request.observers[observer].position;
    return std::hypot(c.x - o.x, c.y - o.y);
  };
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (truth[i] == Verdict::kOutside) continue;
    const bool sees = truth[i] == Verdict::kVisible, other_sees = other[i] == Verdict::kVisible;
    ASSERT_EQ(count.get<Counts>().count[i], sees + other_sees);
    ASSERT_EQ(any.visible[i] == Verdict::kVisible, sees || other_sees);
    ASSERT_EQ(which.get<ObserverSets>().words[i], (sees ? 1U : 0U) + (other_sees ? 2U : 0U));
    const bool first_nearer = sees && (!other_sees || distance(0, i) <= distance(1, i));
    ASSERT_EQ(nearest.get<NearestObservers>().number[i], first_nearer ? 1 : other_sees ? 2 : 0);
  }
}

/// Heights and angles, whose ground is read as a whole in any memory.
void expect_heights_at_any_memory(const Terrain& terrain, Request request, const Result& visible) {
  NoProgress progress;
  request.mode = Mode::kHeight;
  const Result all = test::compute_at_full_detail(terrain.store(), request, {}, progress).result;
  const Result parts =
      test::compute_at_full_detail(terrain.store(), request, {.memory_bytes = 16000000, .lattices = false}, progress)
          .result;
  EXPECT_TRUE(all.visible == visible.visible);
  EXPECT_TRUE(parts.visible == visible.visible);
  for (std::size_t i = 0; i < all.get<LeastHeights>().height_m.size(); ++i) {
    const float a = all.get<LeastHeights>().height_m[i], b = parts.get<LeastHeights>().height_m[i];
    ASSERT_TRUE(a == b || (std::isnan(a) && std::isnan(b))) << a << ", " << b;
  }
  request.mode = Mode::kAngle;
  const auto angles = [&](std::uint64_t memory) {
    return test::compute_at_full_detail(terrain.store(), request, {.memory_bytes = memory, .lattices = false}, progress)
        .result.get<Angles>()
        .angle_deg;
  };
  const std::vector<float> whole = angles(1 << 30), cut = angles(16000000);
  EXPECT_TRUE(std::equal(whole.begin(), whole.end(), cut.begin(), cut.end(),
                         [](float a, float b) { return a == b || (std::isnan(a) && std::isnan(b)); }));
}

/// Blockers and probabilities are asked of the triangles of each segment.
void expect_studies_at_any_memory(const Terrain& terrain, Request request) {
  NoProgress progress;
  request.cell_size = 4 * *request.cell_size;
  request.vertical_error = {1.5, 40};
  for (const Mode mode : {Mode::kBlocker, Mode::kProbability}) {
    request.mode = mode;
    const Result all = test::compute_at_full_detail(terrain.store(), request, {}, progress).result;
    const Result parts =
        test::compute_at_full_detail(terrain.store(), request, {.memory_bytes = 16000000}, progress).result;
    EXPECT_GT(parts.statistics.triangles, all.statistics.triangles) << "not in segments";
    test::expect_same_result(all, parts);
  }
}

/// Heights err alike wherever the window ends.
TEST(Probability, IsThatOfTheLineWhateverTheWindow) {
  const test::CardiffTerrain heights;
  const Terrain terrain(200, [&](int c, int r) { return heights(c + 300, r + 300); });
  NoProgress progress;
  Request request = look(terrain.at(3000, 3000), 20, 2, 60);
  request.mode = Mode::kProbability;
  request.vertical_error = {2, 50};
  request.radius = 1000;
  const Result near = compute(terrain.store(), request, progress);
  request.grid = near.grid;
  request.cell_size.reset();
  request.radius = 1900;
  const Result far = compute(terrain.store(), request, progress);
  std::size_t probable = 0;
  for (std::size_t i = 0; i < near.get<Probabilities>().probability.size(); ++i) {
    if (std::isnan(near.get<Probabilities>().probability[i])) continue;
    ASSERT_EQ(near.get<Probabilities>().probability[i], far.get<Probabilities>().probability[i]);
    probable += near.get<Probabilities>().probability[i] > 0.05F && near.get<Probabilities>().probability[i] < 0.95F;
  }
  EXPECT_GT(probable, 50U);
}

TEST(Precise, TheMemoryChangesNothingOnTheWholeSample) {
  // Large enough for pieces of several levels about the observer, that overlap.
  const test::CardiffTerrain heights;
  const Terrain terrain(600, [&](int c, int r) { return heights(c + 200, r + 200); });
  NoProgress progress;
  for (const double target : {0.0, 2.0}) {
    const Request request = look(terrain.at(381.3, 7002.4), 2, target, 60);
    const Result result = test::compute_at_full_detail(terrain.store(), request, {}, progress).result;
    const RetrievedSurface full{terrain.full(), nullptr, {}};
    const LineTester whole(full, request.earth, 0);  // without rays
    for (const std::uint64_t memory : {std::uint64_t{16000000}, std::uint64_t{1300000}}) {
      const Result other =
          test::compute_at_full_detail(terrain.store(), request, {.memory_bytes = memory, .lattices = false}, progress)
              .result;
      EXPECT_TRUE(result.visible == other.visible) << "memory " << memory;
    }
    expect_heights_at_any_memory(terrain, request, result);
    expect_studies_at_any_memory(terrain, request);
    // And every triangle that may rise above the line.
    const Eye eye = eye_of(terrain.full().grid, request, request.observers[0],
                           height_on(terrain.full(), request.observers[0].position));
    const double resolution = terrain.full().grid.resolution;
    std::uint64_t different = 0;
    for (std::size_t i = 0; i < result.visible.size(); i += 61) {
      if (result.visible[i] == Verdict::kOutside) continue;
      const auto columns = result.grid.columns();
      const Point2 c =
          result.grid.centre(static_cast<std::int64_t>(i) % columns, static_cast<std::int64_t>(i) / columns);
      SightLines lines;
      lines.active = 1;
      lines.from_x[0] = eye.units.x, lines.from_y[0] = eye.units.y, lines.from_z[0] = eye.units.z;
      lines.to_x[0] = easting_in_units(terrain.full().grid, c.x);
      lines.to_y[0] = northing_in_units(terrain.full().grid, c.y);
      lines.to_z[0] = (*height_on(terrain.full(), c) + target) / resolution;
      different += (result.visible[i] == Verdict::kHidden) != (whole.hidden(lines) == 1);
    }
    EXPECT_EQ(different, 0U);
  }
}

TEST(Precise, TheBruteForceAgreesWithALineOfSightThatSharesNoCode) {
  const Terrain terrain = cardiff(40);
  const Request request = look(terrain.at(1004.2, 811.9), 10, 2, 97);
  NoProgress progress;
  const RasterGrid cells = compute(terrain.store(), request, progress).grid;
  const std::vector<Verdict> values = brute_force(terrain, request, cells);
  const test::ExactLineOfSight exact(terrain.full(), request.earth);
  const Point2 o = request.observers[0].position;
  const Point3 from{o.x, o.y, *exact.height(o) + 10};
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto column = static_cast<std::int64_t>(i) % cells.columns(),
               row = static_cast<std::int64_t>(i) / cells.columns();
    const Point2 c = cells.centre(column, row);
    if (values[i] == Verdict::kOutside) continue;
    const double clearance = exact.clearance(from, {c.x, c.y, *exact.height(c) + 2});
    if (std::abs(clearance) < 2e-6) continue;
    ASSERT_EQ(values[i], clearance < 0 ? Verdict::kHidden : Verdict::kVisible);
  }
}

}  // namespace
}  // namespace itin::viewshed
