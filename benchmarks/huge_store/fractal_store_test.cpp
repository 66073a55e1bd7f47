// A fractal store is what an importer could have written, and its certificates hold.
#include "huge_store/fractal_store.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <itin/certificate.hpp>
#include <itin/import.hpp>
#include <itin/lattice_tin.hpp>
#include <itin/parallel.hpp>
#include <itin/store.hpp>
#include <itin/triangulate.hpp>

#include "huge_store/square.hpp"
#include "store/file/store_rows.hpp"
#include "support/raster_file.hpp"
#include "support/row_bytes.hpp"
#include "support/sound_store.hpp"
#include "support/temporary_directory.hpp"

namespace itin::huge {
namespace {

constexpr double kSideKm = 0.5;
constexpr std::int32_t kSide = 512, kPosts = kSide + 1;

class FractalStoreTest : public testing::Test {
 protected:
  FractalStoreTest() { report_ = write_fractal_store(path_, options_, progress_); }

  LatticeTin lattice(double tolerance) {
    const Tin tin = triangulate(Store(path_), Window::all(), Detail::tolerance(tolerance), progress_);
    auto found = lattice_of(tin);
    EXPECT_TRUE(found.has_value()) << tolerance;
    return std::move(*found);
  }

  const test::TemporaryDirectory directory_;
  const std::string path_ = directory_.file("f.itin");
  const FractalStoreOptions options_{kSideKm};
  NoProgress progress_;
  FractalStoreReport report_;
};

/// Height in grid units at a grid position, where all cells have falling diagonals.
double height_at(const LatticeTin& lattice, std::int32_t x, std::int32_t y) {
  const auto column = std::min(static_cast<std::uint32_t>((x - lattice.west) / lattice.spacing), lattice.columns - 2);
  const auto row = std::min(static_cast<std::uint32_t>((lattice.north - y) / lattice.spacing), lattice.rows - 2);
  const double east = 1.0 * (x - lattice.x(column)) / lattice.spacing,
               south = 1.0 * (lattice.y(row) - y) / lattice.spacing;
  const std::int32_t* const upper = lattice.posts(lattice.cell(column, row));
  const std::int32_t* const lower = upper + LatticeTin::kPosts;
  const double nw = upper[0], ne = upper[1], sw = lower[0], se = lower[1];
  return east <= south ? nw + south * (sw - nw) + east * (se - sw) : nw + east * (ne - nw) + south * (se - ne);
}

TEST_F(FractalStoreTest, IsSound) {
  const Store store(path_);
  test::expect_sound(store);
  EXPECT_EQ(report_.side_m, kSide);
  EXPECT_EQ(report_.posts, std::uint64_t{kPosts} * kPosts);
  EXPECT_EQ(store.metadata().vertices, report_.posts);
  EXPECT_EQ(store.metadata().bounds, Square(kSide).ground());
}

TEST_F(FractalStoreTest, HasTheSurfaceThatAnImportOfItsPostsHas) {
  const LatticeTin full = lattice(0);
  const std::string raster = directory_.file("f.tif"), imported = directory_.file("i.itin");
  const Box box = full.grid.box(Square(kSide).ground());
  // The lattice has a bare column and row about it.
  test::write_raster(raster, {box.xmin - 0.5, box.ymax + 0.5, 1, kPosts, kPosts, 32630}, [&](int column, int row) {
    const std::int32_t x = full.x(static_cast<std::uint32_t>(column + 1)),
                       y = full.y(static_cast<std::uint32_t>(row + 1));
    return height_at(full, x, y) * full.grid.resolution;
  });
  ImportOptions options;
  options.sources = {raster};
  import_terrain(imported, options, progress_);
  const Store a(path_), b(imported);
  EXPECT_EQ(a.metadata().grid, b.metadata().grid);
  EXPECT_EQ(a.metadata().crs_wkt, b.metadata().crs_wkt);
  EXPECT_EQ(a.metadata().bounds, b.metadata().bounds);
  EXPECT_EQ(a.metadata().sources[0].gap_basis, b.metadata().sources[0].gap_basis);
  ASSERT_EQ(a.metadata().levels.size(), b.metadata().levels.size());
  for (std::size_t k = 0; k < a.metadata().levels.size(); ++k)
    EXPECT_EQ(a.metadata().levels[k].tolerance, b.metadata().levels[k].tolerance);
  const Tin ours = triangulate(a, Window::all(), Detail::tolerance(0), progress_),
            theirs = triangulate(b, Window::all(), Detail::tolerance(0), progress_);
  EXPECT_EQ(ours.vertices, theirs.vertices);
  EXPECT_EQ(ours.triangles, theirs.triangles);
}

/// Both surfaces are linear between neighbouring positions looked at, except where cells' borders lie between them.
TEST_F(FractalStoreTest, HasCertificatesThatHold) {
  constexpr std::int32_t step = Square::kSpacing / 4;
  const LatticeTin full = lattice(0);
  const Store store(path_);
  const GridBox ground = store.metadata().bounds;
  for (std::size_t k = 1; k < store.metadata().levels.size(); ++k) {
    const LevelInfo& level = store.metadata().levels[k];
    EXPECT_GE(level.certified_error.lo, -level.tolerance);
    EXPECT_LE(level.certified_error.hi, level.tolerance);
    const LatticeTin coarse = lattice(level.tolerance);
    for (std::uint32_t cell = 0; cell < coarse.tiles.size() * LatticeTin::kCells; ++cell)
      ASSERT_TRUE(coarse.halves(cell) == 0 || coarse.halves(cell) == LatticeTin::kFalling);
    const Certificate certificate = store.certificate(static_cast<int>(k), full.grid.box(ground));
    double lo = 0, hi = 0;
    for (std::int32_t y = ground.ymin; y <= ground.ymax; y += step) {
      for (std::int32_t x = ground.xmin; x <= ground.xmax; x += step) {
        const double difference = height_at(full, x, y) - height_at(coarse, x, y);
        const auto bounds = certificate.over({x, y, x, y});
        ASSERT_TRUE(bounds.has_value());
        ASSERT_GE(difference, bounds->lo - 1e-6) << "level " << k << " at " << x << " " << y;
        ASSERT_LE(difference, bounds->hi + 1e-6) << "level " << k << " at " << x << " " << y;
        lo = std::min(lo, difference), hi = std::max(hi, difference);
      }
    }
    // The certificate is tight, too: no wider than the level's worst place, up to rounding to the grid.
    EXPECT_NEAR(level.certified_error.lo, lo * full.grid.resolution, 0.0101);
    EXPECT_NEAR(level.certified_error.hi, hi * full.grid.resolution, 0.0101);
  }
}

std::vector<std::pair<std::uint64_t, std::vector<std::uint8_t>>> rows_of(const std::string& path) {
  const StoreRows rows(path);
  std::vector<std::pair<std::uint64_t, std::vector<std::uint8_t>>> result;
  for (const BlobKind kind : {BlobKind::Directory, BlobKind::Block})
    rows.for_each_key(kind, [&](std::uint64_t key) { result.emplace_back(key, test::bytes_of(rows, kind, key)); });
  return result;
}

TEST_F(FractalStoreTest, IsTheSameWithOneThread) {
  const std::string one = directory_.file("one.itin");
  set_thread_count(1);
  write_fractal_store(one, options_, progress_);
  set_thread_count(0);
  EXPECT_EQ(rows_of(path_), rows_of(one));
}

}  // namespace
}  // namespace itin::huge
