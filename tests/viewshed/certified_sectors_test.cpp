// Certified viewsheds sector by sector, against the level as a whole and the exact answer.

#include <cmath>
#include <filesystem>
#include <random>

#include <gtest/gtest.h>

#include <itin/import.hpp>
#include <itin/store.hpp>
#include <viewshed/result.hpp>

#include "certify/level_source.hpp"
#include "support/full_detail.hpp"
#include "support/raster_file.hpp"
#include "support/seed.hpp"
#include "support/temporary_directory.hpp"
#include "support/terrain_tin.hpp"

namespace itin::viewshed {
namespace {

constexpr int kSide = 257;
constexpr double kStep = 25, kWest = 300000, kNorth = 200000;

TEST(CertifiedSectors, SayWhatTheLevelSaysAndNothingWrong) {
  std::mt19937 random(test::seed());
  NoProgress progress;
  const test::TemporaryDirectory directory;
  std::size_t certain = 0, differ = 0;
  for (const double void_radius : {0.0, 30.0}) {
    std::filesystem::remove(directory.file("t.itin"));
    const std::vector<double> z = test::fractal_heights(kSide, 300, 0.6, random());
    test::write_raster(directory.file("t.tif"), {kWest, kNorth, kStep, kSide, kSide, 27700}, [&](int c, int r) {
      const bool missing = std::hypot(c - 100, r - 140) < void_radius;
      return missing ? NAN : z[static_cast<std::size_t>(r) * kSide + static_cast<std::size_t>(c)];
    });
    ImportOptions options;
    options.sources = {directory.file("t.tif")};
    import_terrain(directory.file("t.itin"), options, progress);
    const Store store(directory.file("t.itin"));
    for (const NoData rule : {NoData::kClear, NoData::kBlock, NoData::kUnknown}) {
      Request request;
      std::uniform_real_distribution<double> share(0.7, 0.95);
      for (int i = 0; i < 2; ++i) {
        Observer observer;
        observer.position = {kWest + share(random) * kSide * kStep, kNorth - (1 - share(random)) * kSide * kStep};
        observer.height = 80;
        request.observers.push_back(observer);
      }
      request.observers[0].radius = 3000;
      request.target_height = 30;
      request.cell_size = 40;
      request.nodata = rule;
      request.mode = Mode::kVisible;
      const Result exact = test::compute_at_full_detail(store, request, {}, progress).result;
      request.detail = Detail::tolerance(16);
      const Result whole = certify_by_blocks(store, request, {}, progress).result;
      ASSERT_GT(whole.cells.undecided, 0U) << "not of the level";
      const Result parts = certify_by_sectors(store, request, 700, {}, progress).result;
      ASSERT_EQ(parts.visible.size(), exact.visible.size());
      ASSERT_EQ(parts.visible.size(), whole.visible.size());
      CellCounts cells;
      for (std::size_t i = 0; i < parts.visible.size(); ++i) {
        const Verdict value = parts.visible[i];
        ASSERT_EQ(value == Verdict::kOutside, exact.visible[i] == Verdict::kOutside) << i;
        // The certified answer may leave open what the exact one decides.
        if (value == Verdict::kVisible) {
          ASSERT_EQ(exact.visible[i], Verdict::kVisible) << i;
        } else if (value == Verdict::kHidden) {
          ASSERT_EQ(exact.visible[i], Verdict::kHidden) << i;
        }
        certain += value == Verdict::kVisible || value == Verdict::kHidden ? 1 : 0;
        if (value != whole.visible[i]) {
          ASSERT_TRUE(value == Verdict::kUndecided || whole.visible[i] == Verdict::kUndecided) << i;
          ++differ;
        }
        ++(value == Verdict::kOutside     ? cells.outside
           : value == Verdict::kUndecided ? cells.undecided
           : value == Verdict::kVisible   ? cells.visible
                                          : cells.hidden);
      }
      EXPECT_EQ(parts.cells.visible, cells.visible);
      EXPECT_EQ(parts.cells.hidden, cells.hidden);
      EXPECT_EQ(parts.cells.undecided, cells.undecided);
      EXPECT_EQ(parts.cells.outside, cells.outside);
      EXPECT_GT(parts.statistics.retrieval.points_read, 2 * whole.statistics.retrieval.points_read) << "not in sectors";
    }
  }
  EXPECT_GT(certain, 10000U);
  // Bins are smaller in a sector.
  EXPECT_LT(8 * differ, certain);
}

}  // namespace
}  // namespace itin::viewshed
