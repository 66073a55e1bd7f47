// Whole imports: order, addition, holes, replacement, interruption.
#include <algorithm>
#include <atomic>
#include <filesystem>
#include <fstream>
#include <iterator>

#include <gtest/gtest.h>

#include <itin/import.hpp>
#include <itin/parallel.hpp>
#include <itin/store.hpp>
#include <itin/triangulate.hpp>

#include "support/raster_file.hpp"
#include "support/temporary_directory.hpp"

namespace itin {
namespace {

using test::RasterShape;

Tin whole(const Store& store, double tolerance) {
  NoProgress progress;
  return triangulate(store, Window::all(), Detail::tolerance(tolerance), progress);
}

void import(const std::string& store, const std::vector<std::string>& sources, bool replace = false) {
  ImportOptions options;
  options.sources = sources;
  options.replace = replace;
  NoProgress progress;
  import_terrain(store, options, progress);
}

/// Geometry, levels and certificates.
void expect_same_surface(const std::string& a, const std::string& b) {
  const Store first(a), second(b);
  ASSERT_EQ(first.metadata().vertices, second.metadata().vertices);
  for (std::size_t k = 0; k < first.metadata().levels.size(); ++k) {
    const LevelInfo &one = first.metadata().levels[k], &other = second.metadata().levels[k];
    EXPECT_EQ(one.vertices, other.vertices) << "level " << k;
    EXPECT_EQ(one.certified_error.lo, other.certified_error.lo) << "level " << k;
    EXPECT_EQ(one.certified_error.hi, other.certified_error.hi) << "level " << k;
    const Tin t = whole(first, one.tolerance), u = whole(second, one.tolerance);
    EXPECT_EQ(t.vertices, u.vertices) << "level " << k;
    EXPECT_EQ(t.triangles, u.triangles) << "level " << k;
  }
}

std::string bytes_of(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

class ImportTerrain : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return directory_.file(name); }

  /// A piece of the bundled terrain, `columns` x `rows` posts from (column, row) on.
  std::string piece(const std::string& name, int column, int row, int columns, int rows) const {
    const RasterShape shape{300000 + 50.0 * column, 200000 - 50.0 * row, 50, columns, rows, 27700};
    test::write_raster(path(name), shape, [&](int c, int r) { return terrain_(400 + column + c, 100 + row + r); });
    return path(name);
  }

  test::TemporaryDirectory directory_;
  test::CardiffTerrain terrain_;
};

TEST_F(ImportTerrain, OrderAndPortionsDoNotMatter) {
  const std::vector<std::string> tiles{piece("a.tif", 0, 0, 60, 60), piece("b.tif", 59, 0, 60, 60),
                                       piece("c.tif", 0, 60, 60, 40), piece("d.tif", 60, 60, 59, 40)};
  import(path("once.itin"), tiles);
  import(path("backwards.itin"), {tiles[3], tiles[2], tiles[1], tiles[0]});
  import(path("later.itin"), {tiles[2]});
  import(path("later.itin"), {tiles[0], tiles[3]});
  import(path("later.itin"), {tiles[1]});
  expect_same_surface(path("once.itin"), path("backwards.itin"));
  expect_same_surface(path("once.itin"), path("later.itin"));
  EXPECT_EQ(Store(path("once.itin")).metadata().vertices, 119u * 100u);
}

TEST_F(ImportTerrain, ThreadsDoNotMatter) {
  const std::string tile = piece("a.tif", 0, 0, 150, 150);
  set_thread_count(1);
  import(path("one.itin"), {tile});
  set_thread_count(0);
  import(path("many.itin"), {tile});
  expect_same_surface(path("one.itin"), path("many.itin"));
}

TEST_F(ImportTerrain, NothingIsTriangulatedAcrossVoids) {
  const RasterShape shape;
  const auto is_void = [](int c, int r) {
    return (c > 10 && c < 20 && r > 5 && r < 30) || (c == 30 && r == 30) || c + r < 6;
  };
  test::write_raster(path("v.tif"), shape, [&](int c, int r) { return is_void(c, r) ? std::nan("") : terrain_(c, r); });
  import(path("v.itin"), {path("v.tif")});
  const Store store(path("v.itin"));
  for (const LevelInfo& level : store.metadata().levels) {
    const Tin tin = whole(store, level.tolerance);
    double area = 0;
    for (const Triangle& t : tin.triangles) {
      const Point3 a = tin.point(t[0]), b = tin.point(t[1]), c = tin.point(t[2]);
      area += ((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)) / 2;
      for (int row = 0; row < shape.rows; ++row) {
        for (int column = 0; column < shape.columns; ++column) {
          if (!is_void(column, row)) continue;
          const double x = shape.xmin + (column + 0.5) * shape.step, y = shape.ymax - (row + 0.5) * shape.step;
          const auto left = [&](const Point3& p, const Point3& q) {
            return (q.x - p.x) * (y - p.y) - (q.y - p.y) * (x - p.x) > 0;
          };
          EXPECT_FALSE(left(a, b) && left(b, c) && left(c, a))
              << "a triangle over the void at " << column << ", " << row;
        }
      }
    }
    // Every square of four posts is ground, and half of each square of three.
    int squares = 0, halves = 0;
    for (int row = 0; row + 1 < shape.rows; ++row) {
      for (int column = 0; column + 1 < shape.columns; ++column) {
        const int voids =
            is_void(column, row) + is_void(column + 1, row) + is_void(column, row + 1) + is_void(column + 1, row + 1);
        squares += voids == 0;
        halves += voids == 1;
      }
    }
    EXPECT_DOUBLE_EQ(area, (squares + 0.5 * halves) * shape.step * shape.step) << "tolerance " << level.tolerance;
  }
}

/// A new survey takes the place of an old one as fine, in either order, and also where its posts lie beside the old
/// ones.
TEST_F(ImportTerrain, GroundAsFineIsReplacedInEitherOrder) {
  const RasterShape old{300000, 200000, 10, 60, 60, 27700};
  test::write_raster(path("old.tif"), old, [](int c, int r) { return 300 + (c * 5 + r * 3) % 7; });
  for (const double aside : {0.0, 4.0}) {
    const std::string a = path(aside == 0 ? "a.itin" : "c.itin"), b = path(aside == 0 ? "b.itin" : "d.itin");
    test::write_raster(path("new.tif"), {300200 + aside, 199900 + aside, 10, 20, 20, 27700},
                       [](int c, int r) { return 100 + (c * 7 + r * 3) % 11; });
    import(a, {path("old.tif")});
    import(a, {path("new.tif")}, true);
    import(b, {path("new.tif")}, true);
    import(b, {path("old.tif")});
    expect_same_surface(a, b);
    std::size_t of_new = 0;
    const Tin tin = whole(Store(a), 0);
    for (std::size_t v = 0; v < tin.vertices.size(); ++v) {
      const Point3 p = tin.point(static_cast<std::uint32_t>(v));
      const bool inside =
          p.x >= 300205 + aside && p.x <= 300395 + aside && p.y <= 199895 + aside && p.y >= 199705 + aside;
      EXPECT_EQ(inside, p.z < 200) << p.x << " " << p.y;
      of_new += inside;
    }
    EXPECT_EQ(of_new, 20U * 20U);
  }
}

TEST_F(ImportTerrain, FinerGroundReplacesCoarserInEitherOrder) {
  const RasterShape coarse{300000, 200000, 50, 40, 40, 27700}, fine{300500, 199500, 10, 50, 40, 27700};
  test::write_raster(path("coarse.tif"), coarse, [](int c, int r) { return 100 + c + 2 * r; });
  test::write_raster(path("fine.tif"), fine, [](int c, int r) { return 300 + (c * 7 + r * 3) % 11; });
  import(path("a.itin"), {path("coarse.tif")});
  import(path("a.itin"), {path("fine.tif")}, true);
  import(path("b.itin"), {path("fine.tif")}, true);
  import(path("b.itin"), {path("coarse.tif")});
  import(path("kept.itin"), {path("coarse.tif"), path("fine.tif")});
  expect_same_surface(path("a.itin"), path("b.itin"));
  // 10 x 8 coarse posts lie where a fine one does.
  EXPECT_EQ(Store(path("kept.itin")).metadata().vertices, 40u * 40u + 50u * 40u - 10u * 8u);
  const Tin tin = whole(Store(path("a.itin")), 0);
  for (std::size_t v = 0; v < tin.vertices.size(); ++v) {
    const Point3 p = tin.point(static_cast<std::uint32_t>(v));
    const bool inside = p.x >= 300505 && p.x <= 300995 && p.y <= 199495 && p.y >= 199105;
    EXPECT_EQ(inside, p.z >= 290) << p.x << " " << p.y;
  }
  // The seam is ground: the whole rectangle is covered.
  double area = 0;
  for (const Triangle& t : tin.triangles) {
    const Point3 a = tin.point(t[0]), b = tin.point(t[1]), c = tin.point(t[2]);
    area += ((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)) / 2;
  }
  EXPECT_DOUBLE_EQ(area, 39.0 * 39.0 * 2500);
}

/// Stops at the n-th report.
class Impatient final : public Progress {
 public:
  explicit Impatient(int patience) : patience_(patience) {}
  void report(std::string_view, double) override { --patience_; }
  bool cancelled() const override { return patience_ <= 0; }

 private:
  std::atomic<int> patience_;
};

TEST_F(ImportTerrain, AnInterruptedImportLeavesTheStoreAsItWas) {
  import(path("s.itin"), {piece("a.tif", 0, 0, 60, 60)});
  const std::string before = bytes_of(path("s.itin"));
  const std::string more = piece("b.tif", 60, 0, 60, 60);
  for (int patience = 0; patience < 12; ++patience) {
    ImportOptions options;
    options.sources = {more};
    Impatient progress(patience);
    EXPECT_THROW(import_terrain(path("s.itin"), options, progress), Cancelled) << patience;
    EXPECT_EQ(bytes_of(path("s.itin")), before);
  }
  for (const auto& entry : std::filesystem::directory_iterator(directory_.path())) {
    EXPECT_TRUE(entry.path().extension() == ".itin" || entry.path().extension() == ".tif") << entry.path();
  }
}

}  // namespace
}  // namespace itin
