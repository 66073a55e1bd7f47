// The parts of a raster that are read because an eye may see them, and rasters read sector by sector, against the
// whole.
#include "scene/reveal.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <optional>
#include <random>

#include <gtest/gtest.h>

#include <itin/error.hpp>
#include <itin/import.hpp>
#include <viewshed/surface.hpp>
#include <viewshed/viewshed.hpp>

#include "bounds/binned_heights.hpp"
#include "bounds/surface_heights.hpp"
#include "exact/lattice_sectors.hpp"
#include "support/full_detail.hpp"
#include "support/raster_file.hpp"
#include "support/same_result.hpp"
#include "support/seed.hpp"
#include "support/temporary_directory.hpp"
#include "support/terrain_tin.hpp"

namespace itin::viewshed {
namespace {

using Heights = LatticeReader::Heights;

class Reveal : public testing::Test {
 protected:
  static constexpr int kSide = 513;
  static constexpr double kStep = 25, kWest = 300000, kNorth = 200000;

  /// A fractal with a void, or none, and a ridge that hides the west from the east.
  void make(double relief, double void_radius) {
    const std::vector<double> z = test::fractal_heights(kSide, relief, 0.7, random_());
    make_of([&](int c, int r) {
      const bool missing = std::hypot(c - 0.4 * kSide, r - 0.55 * kSide) < void_radius;
      const double ridge = c >= 240 && c < 264 ? 4000 : 0;
      return missing ? NAN : ridge + z[static_cast<std::size_t>(r) * kSide + static_cast<std::size_t>(c)];
    });
  }
  template <class HeightAt>
  void make_of(const HeightAt& height_at) {
    store_.reset();
    std::filesystem::remove(directory_.file("t.itin"));
    test::write_raster(directory_.file("t.tif"), {kWest, kNorth, kStep, kSide, kSide, 27700}, height_at);
    ImportOptions options;
    options.sources = {directory_.file("t.tif")};
    import_terrain(directory_.file("t.itin"), options, progress_);
    store_.emplace(directory_.file("t.itin"));
  }

  /// From places near the north-eastern corner, where no void is.
  Request look(std::size_t observers) {
    std::uniform_real_distribution<double> share(0.7, 0.95);
    Request request;
    for (std::size_t i = 0; i < observers; ++i) {
      Observer observer;
      observer.position = {kWest + share(random_) * kSide * kStep, kNorth - (1 - share(random_)) * kSide * kStep};
      observer.height = 5;
      request.observers.push_back(observer);
    }
    request.target_height = 2;
    request.cell_size = 40;
    return request;
  }

  RetrievedSurface surface(Heights heights) {
    return *retrieve_lattice(*store_, Window::all(), Detail::tolerance(0), ThemeChoice::none(), heights, kAnyLattice,
                             progress_);
  }

  static void expect_same(const Result& a, const Result& b) {
    EXPECT_EQ(a.grid.cell_count(), b.grid.cell_count());
    EXPECT_EQ(a.ground_m, b.ground_m);
    EXPECT_TRUE(a.visible == b.visible);
    EXPECT_TRUE(test::same_values(a.values, b.values));
    EXPECT_EQ(a.cells.visible, b.cells.visible);
    EXPECT_EQ(a.cells.hidden, b.cells.hidden);
    EXPECT_EQ(a.cells.outside, b.cells.outside);
    EXPECT_EQ(a.warnings, b.warnings);
  }

  std::mt19937 random_{test::seed()};
  NoProgress progress_;
  std::optional<Store> store_;

 private:
  test::TemporaryDirectory directory_;
};

constexpr Mode kModes[] = {Mode::kVisible, Mode::kCount, Mode::kWhich, Mode::kAngle, Mode::kNearest, Mode::kHeight};

TEST_F(Reveal, ChangesNothingAndLeavesOutWhatNobodySees) {
  for (const double void_radius : {0.0, 60.0}) {
    make(700, void_radius);
    for (const Mode mode : kModes) {
      Request request = look(mode == Mode::kVisible ? 1 : 3);
      request.mode = mode;
      if (void_radius > 0) request.nodata = mode == Mode::kAngle ? NoData::kBlock : NoData::kClear;
      if (mode == Mode::kCount) request.observers[1].radius = 4000, request.observers[2].azimuth = AngleRange{200, 300};
      if (mode == Mode::kNearest) request.earth.refraction = 0.9;
      const RetrievedSurface whole = surface(Heights::kAll), revealed = surface(Heights::kNone);
      const Result result = compute(revealed, nullptr, request, progress_);
      expect_same(compute(whole, nullptr, request, progress_), result);
      std::size_t unread = 0;
      for (const LatticeTin::Tile& tile : revealed.lattice->lattice().tiles)
        unread += tile.ground != LatticeTin::Ground::kNone && !tile.heights ? 1 : 0;
      if (mode == Mode::kHeight) {
        EXPECT_EQ(unread, 0U);
      } else if (mode == Mode::kVisible && void_radius == 0) {
        EXPECT_GT(unread, 15U);
      }
    }
  }
}

TEST_F(Reveal, WhatIsToldOfABoxHoldsAllOverIt) {
  // Ground reaches up to the sides of tiles without any: the lattice begins one post before the data.
  make_of([](int c, int r) {
    constexpr int tile_side = LatticeTin::kSide;
    const auto missing = [](int at) { return at + 1 > 2 * tile_side && at + 1 < 5 * tile_side; };
    return missing(c) && missing(r) ? NAN : 100.0 + (7 * c + 13 * r) % 50;
  });
  const RetrievedSurface unread = surface(Heights::kNone);
  const LatticeTin& lattice = unread.lattice->lattice();
  const BinnedHeights heights(lattice);
  using Expanse = BinnedHeights::Expanse;
  std::map<Expanse, int> found;
  // Corners on the sides of tiles, on posts and anywhere, beyond the data, too.
  const std::int64_t spacing = lattice.spacing, tile = spacing * LatticeTin::kSide;
  const auto somewhere = [&](double at) {
    const std::int64_t step = std::array{tile, spacing, std::int64_t{1}}[random_() % 3];
    std::uniform_int_distribution<std::int64_t> steps(-2 * tile / step, (kSide * spacing + 2 * tile) / step);
    return at + static_cast<double>(steps(random_) * step);
  };
  for (int i = 0; i < 20000; ++i) {
    const Point2 from{somewhere(lattice.west), lattice.north - somewhere(0)};
    const double side = std::array<double, 4>{0, 1, 40.0 * static_cast<double>(spacing),
                                              2.0 * static_cast<double>(tile)}[random_() % 4];
    const Point2 to{from.x + side, from.y - side};
    const Expanse expanse = heights.expanse(from, to);
    ++found[expanse];
    if (expanse == Expanse::kVarious) continue;
    for (const double x : {from.x, (from.x + to.x) / 2, to.x})
      for (const double y : {from.y, (from.y + to.y) / 2, to.y})
        ASSERT_EQ(heights.height_at({x, y}), expanse == Expanse::kAllUnread ? std::optional(kUnread) : std::nullopt);
  }
  EXPECT_GT(found[Expanse::kAllBare], 100);
  EXPECT_GT(found[Expanse::kAllUnread], 100);
  EXPECT_GT(found[Expanse::kVarious], 100);
}

TEST_F(Reveal, GroundHidesThoughTargetsWithinItAreHidden) {
  // From 100 m, targets at 50 m are hidden by the eastern ridge up to 7 km away, and farther away by the western one,
  // which rises among hidden targets.
  make_of([&](int c, int) { return c >= 412 && c < 420 ? 85.0 : c >= 265 && c < 310 ? 200.0 : 0.01 * (c % 7); });
  Request request = look(1);
  request.observers[0].position = {kWest + 500 * kStep, kNorth - 250 * kStep};
  request.observers[0].height = 100;
  request.target_absolute = true, request.target_height = 50;
  const Result whole = compute(surface(Heights::kAll), nullptr, request, progress_);
  EXPECT_GT(whole.cells.visible, 0U);
  EXPECT_EQ(whole.visible[whole.grid.index({10, whole.grid.rows() / 2})], Verdict::kHidden);
  expect_same(whole, compute(surface(Heights::kNone), nullptr, request, progress_));
  const auto parts = compute_by_lattice_sectors(*store_, request, 800000, {}, progress_);
  ASSERT_TRUE(parts);
  expect_same(whole, parts->result);
}

TEST_F(Reveal, ElevationsAreThoseOfAllGround) {
  make(700, 0);
  Request request = look(1);
  request.elevation = AngleRange{-2, 1};
  const RetrievedSurface whole = surface(Heights::kAll), revealed = surface(Heights::kNone);
  expect_same(compute(whole, nullptr, request, progress_), compute(revealed, nullptr, request, progress_));
}

TEST_F(Reveal, SectorsMakeTheWhole) {
  for (const double void_radius : {0.0, 60.0}) {
    make(400, void_radius);
    for (const Mode mode : kModes) {
      Request request = look(2);
      request.mode = mode;
      if (void_radius > 0) request.nodata = mode == Mode::kWhich ? NoData::kUnknown : NoData::kBlock;
      if (mode == Mode::kAngle) request.radius = 5000;
      const Result whole = compute(*store_, request, progress_);
      if (!request.radius) {
        EXPECT_EQ(whole.crosses_voids, void_radius > 0);
      }
      for (const std::uint64_t memory : {2000000, 800000}) {
        const auto parts = compute_by_lattice_sectors(*store_, request, memory, {}, progress_);
        ASSERT_TRUE(parts);
        expect_same(whole, parts->result);
        EXPECT_GT(parts->result.statistics.triangles, whole.statistics.triangles) << "not in sectors";
      }
    }
  }
}

TEST_F(Reveal, ARadiusBeyondTheDataIsOfTheData) {
  make(400, 0);
  Request request = look(1);
  const Result whole = compute(*store_, request, progress_);
  request.radius = 5e6;
  const Result found = test::compute_at_full_detail(*store_, request, {}, progress_).result;
  EXPECT_EQ(found.grid.cell_count(), whole.grid.cell_count());
  EXPECT_TRUE(found.visible == whole.visible);
}

TEST_F(Reveal, CellsDoNotDependOnWhatIsRead) {
  // West of the coast there is land in a corner beside the disc alone.
  make_of([](int c, int r) { return c < 300 && r > 60 ? NAN : 50 * std::sin(0.03 * c) + 40 * std::cos(0.05 * r); });
  Request request = look(1);
  request.observers[0].position = {kWest + 460 * kStep, kNorth - 250 * kStep};
  request.radius = 200 * kStep;
  request.nodata = NoData::kClear;
  const Result whole = compute(*store_, request, progress_);
  EXPECT_NEAR(whole.grid.bounds().xmin, request.observers[0].position.x - 5000, 40);
  const auto parts = compute_by_lattice_sectors(*store_, request, 800000, {}, progress_);
  ASSERT_TRUE(parts);
  EXPECT_EQ(parts->result.grid.bounds(), whole.grid.bounds());
  expect_same(whole, parts->result);
  Request certified = request;
  certified.detail = Detail::tolerance(16);
  EXPECT_EQ(compute_certified(*store_, certified, {}, progress_).result.grid.bounds(), whole.grid.bounds());
}

TEST_F(Reveal, TooLittleMemoryIsRefused) {
  make(400, 0);
  for (const Mode mode : {Mode::kVisible, Mode::kHeight}) {
    Request request = look(1);
    request.mode = mode;
    EXPECT_THROW(compute_by_lattice_sectors(*store_, request, 20000, {}, progress_), InputError);
  }
}

}  // namespace
}  // namespace itin::viewshed
