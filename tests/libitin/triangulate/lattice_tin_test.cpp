// Rasters' triangulations by their posts alone, against the ones whose triangles are listed.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

#include <itin/error.hpp>
#include <itin/import.hpp>
#include <itin/lattice_reader.hpp>
#include <itin/lattice_tin.hpp>
#include <itin/store.hpp>
#include <itin/topology.hpp>
#include <itin/triangulate.hpp>

#include "support/corner_triangles.hpp"
#include "support/delaunay_tin.hpp"
#include "support/raster_file.hpp"
#include "support/seed.hpp"
#include "support/temporary_directory.hpp"
#include "support/terrain_tin.hpp"
#include "support/vector_file.hpp"

namespace itin {
namespace {

constexpr std::uint64_t kAny = 1 << 24;

using test::TriangleCorners;

/// Every triangle by its corners, the least first, in order.
template <class Surface>
std::vector<TriangleCorners> sorted_triangles(const Surface& surface, std::vector<std::uint32_t> numbers) {
  std::vector<TriangleCorners> result;
  for (const std::uint32_t t : numbers) {
    result.push_back(test::smallest_first(surface.corners(t)));
  }
  std::sort(result.begin(), result.end());
  return result;
}

std::vector<TriangleCorners> ordered_triangles_of(const Tin& tin) {
  std::vector<std::uint32_t> numbers(tin.triangles.size());
  std::iota(numbers.begin(), numbers.end(), 0U);
  return sorted_triangles(tin, numbers);
}

std::vector<TriangleCorners> ordered_triangles_of(const LatticeTin& lattice) {
  std::vector<std::uint32_t> numbers;
  for (std::uint32_t cell = 0; cell < lattice.tiles.size() * LatticeTin::kCells; ++cell)
    lattice.for_each_triangle(cell, [&](std::uint32_t t) {
      EXPECT_EQ(t / 2, cell);
      numbers.push_back(t);
      return true;
    });
  EXPECT_EQ(numbers.size(), lattice.triangle_count());
  return sorted_triangles(lattice, numbers);
}

using Edge = std::pair<GridPlace, GridPlace>;

std::vector<Edge> rim_of(const LatticeTin& lattice) {
  std::vector<Edge> edges;
  for (const RimEdge& e : lattice.rim()) edges.emplace_back(e.from, e.to);
  std::sort(edges.begin(), edges.end());
  return edges;
}

GridPlace place_of(const GridPoint& p) {
  return {p.x, p.y};
}

std::vector<Edge> rim_of(const Tin& tin) {
  std::vector<Edge> edges;
  const auto adjacent = adjacent_triangles(tin);
  for (std::uint32_t t = 0; t < adjacent.size(); ++t) {
    const TriangleCorners corners = tin.corners(t);
    for (std::size_t i = 0; i < 3; ++i)
      if (adjacent[t][i] == kNoNeighbour) edges.emplace_back(place_of(corners[i]), place_of(corners[(i + 1) % 3]));
  }
  std::sort(edges.begin(), edges.end());
  return edges;
}

/// A lattice with posts left out here and there, and triangles as well.
Tin gappy(std::mt19937& random, double share) {
  std::bernoulli_distribution absent(share);
  Tin tin = test::lattice_tin(23, 17, 25,
                              [&](std::int32_t c, std::int32_t r) { return absent(random) ? NAN : c * 0.7 - r * 0.3; });
  std::erase_if(tin.triangles, [&](const Triangle&) { return absent(random); });
  return tin;
}

TEST(LatticeOf, HasTheTrianglesAndTheRimOfTheTin) {
  std::mt19937 random(test::seed());
  for (const double share : {0.0, 0.02, 0.1, 0.15}) {
    const Tin tin = gappy(random, share);
    const auto lattice = lattice_of(tin);
    ASSERT_TRUE(lattice);
    EXPECT_EQ(ordered_triangles_of(*lattice), ordered_triangles_of(tin));
    EXPECT_EQ(rim_of(*lattice), rim_of(tin));
    GridBox box;
    for (const Triangle& t : tin.triangles)
      for (const std::uint32_t v : t) box.extend(tin.vertices[v].x, tin.vertices[v].y);
    EXPECT_EQ(lattice->bounds(), tin.grid.box(box));
  }
}

TEST(LatticeOf, OtherTinsAreNone) {
  std::mt19937 random(test::seed());
  EXPECT_FALSE(lattice_of(Tin{}));
  EXPECT_FALSE(lattice_of(test::random_tin(random, 100, 0)));
  Tin moved = gappy(random, 0);
  ++moved.vertices[random() % moved.vertices.size()].x;
  EXPECT_FALSE(lattice_of(moved));
  // As wide and as high as a cell, but with a corner amid its side.
  Tin wedge;
  wedge.vertices = {{0, 0, 0}, {10, 0, 0}, {5, 10, 0}};
  wedge.triangles = {{0, 1, 2}};
  EXPECT_FALSE(lattice_of(wedge));
  // Two far apart: a grid about both would be empty.
  Tin sparse;
  sparse.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5000, 5000, 0}, {5001, 5000, 0}, {5000, 5001, 0}};
  sparse.triangles = {{0, 1, 2}, {3, 4, 5}};
  EXPECT_FALSE(lattice_of(sparse));
}

class TriangulateLattice : public testing::Test {
 protected:
  static constexpr double kWest = 300000, kNorth = 200000, kStep = 50;

  std::string path(const std::string& name) const { return directory_.file(name); }

  void add_raster(const test::RasterShape& shape, const std::function<double(int, int)>& height) {
    const std::string raster = path(std::to_string(++rasters_) + ".tif");
    test::write_raster(raster, shape, height);
    ImportOptions options;
    options.sources = {raster};
    import_terrain(path("s.itin"), options, progress_);
  }

  double noise(int c, int r) const { return 40 * std::sin(c * 0.31 + r * 0.17) + 15 * std::sin(r * 0.71 - c * 0.2); }

  /// Expects a window to give a lattice with the very triangles, or none. Returns whether there was one.
  bool compare(const Window& window, const ThemeChoice& themes = ThemeChoice::none()) {
    const Store store(path("s.itin"));
    const Tin tin = triangulate(store, window, Detail::tolerance(0), progress_, themes);
    const auto lattice = triangulate_lattice(store, window, themes, kAny, progress_);
    if (!lattice) return false;
    EXPECT_EQ(ordered_triangles_of(*lattice), ordered_triangles_of(tin));
    EXPECT_EQ(rim_of(*lattice), rim_of(tin));
    EXPECT_EQ(lattice->bounds(), tin.bounds());
    read_in_parts(store, window, themes, tin);
    const Tin listed = lattice->tin();
    EXPECT_EQ(listed.vertices, tin.vertices);
    EXPECT_EQ(listed.triangles, tin.triangles);
    return true;
  }

  /// Heights that are read later come out the same, and bounds tell no less.
  void read_in_parts(const Store& store, const Window& window, const ThemeChoice& themes, const Tin& tin) {
    const auto reader = LatticeReader::open(store, window, themes, LatticeReader::Heights::kNone, kAny, progress_);
    ASSERT_TRUE(reader);
    const LatticeTin& lattice = reader->lattice();
    EXPECT_EQ(lattice.triangle_count(), tin.triangles.size());
    EXPECT_EQ(rim_of(lattice), rim_of(tin));
    const auto tile = static_cast<std::uint32_t>(random_() % lattice.tiles.size());
    struct : Progress {
      void report(std::string_view, double) override {}
      bool cancelled() const override { return true; }
    } stopped;
    if (lattice.tiles[tile].ground != LatticeTin::Ground::kNone) {
      EXPECT_THROW(reader->read(std::vector{tile}, stopped), Cancelled);
    }
    EXPECT_FALSE(lattice.tiles[tile].heights) << "heights that were not read";
    reader->read(std::vector{tile}, progress_);
    EXPECT_EQ(lattice.tiles[tile].heights != nullptr, lattice.tiles[tile].ground != LatticeTin::Ground::kNone);
    reader->read_all(progress_);
    EXPECT_EQ(ordered_triangles_of(lattice), ordered_triangles_of(tin));
    for (std::uint32_t cell = 0; cell < lattice.tiles.size() * LatticeTin::kCells; ++cell)
      lattice.for_each_triangle(cell, [&](std::uint32_t t) {
        for (const GridPoint& p : lattice.corners(t)) EXPECT_LE(p.z, reader->highest(cell / LatticeTin::kCells));
        return true;
      });
  }

  Point2 place(double extent) {
    std::uniform_real_distribution<double> share(-0.1, 1.1);
    return {kWest + share(random_) * extent, kNorth - share(random_) * extent};
  }

  Window random_window(double extent) {
    std::uniform_real_distribution<double> size(0.02, 0.7);
    const double radius = size(random_) * extent;
    const Point2 p = place(extent), q = place(extent);
    switch (random_() % 5) {
      case 0:
        return Window::disc(p, radius);
      case 1:
        return Window::box({p.x, p.y, p.x + radius, p.y + radius});
      case 2:
        return Window::wedge(p, size(random_) * 360, 40, radius);
      case 3: {
        std::vector<Window::Polygon> parts = Window::disc(p, radius / 3).parts();
        parts.push_back(Window::disc(q, radius / 3).parts().front());
        return Window::polygons(std::move(parts));
      }
      default:
        return Window::all();
    }
  }

  std::mt19937 random_{test::seed()};
  NoProgress progress_;

 private:
  test::TemporaryDirectory directory_;
  int rasters_ = 0;
};

TEST_F(TriangulateLattice, IsTheTriangulationOfEveryWindowOfARaster) {
  for (const double share : {0.0, 0.03, 0.3}) {
    std::filesystem::remove(path("s.itin"));
    std::bernoulli_distribution absent(share);
    add_raster({kWest, kNorth, kStep, 150, 150, 27700}, [&](int c, int r) {
      const bool hole = std::hypot(c - 70, r - 80) < 9 || absent(random_);
      return share > 0 && hole ? NAN : noise(c, r);
    });
    int lattices = 0;
    for (int i = 0; i < 40; ++i) lattices += compare(random_window(150 * kStep)) ? 1 : 0;
    EXPECT_TRUE(compare(Window::all()));
    EXPECT_GE(lattices, 12) << share;
  }
}

TEST_F(TriangulateLattice, RastersSideBySide) {
  std::uniform_int_distribution<int> gap(-2, 3);
  for (int i = 0; i < 6; ++i) {
    std::filesystem::remove(path("s.itin"));
    add_raster({kWest, kNorth, kStep, 30, 50, 27700}, [&](int c, int r) { return noise(c, r); });
    const double east = kWest + (30 + gap(random_)) * kStep;
    add_raster({east, kNorth - gap(random_) * kStep, kStep, 30, 50, 27700},
               [&](int c, int r) { return noise(c + 30, r); });
    EXPECT_TRUE(compare(Window::all()));
    for (int k = 0; k < 8; ++k) compare(random_window(60 * kStep));
  }
}

TEST_F(TriangulateLattice, OtherGroundBesideIsNoneOrTheSame) {
  for (const double step : {100.0, 150.0, 65.0}) {
    std::filesystem::remove(path("s.itin"));
    add_raster({kWest, kNorth, kStep, 40, 40, 27700}, [&](int c, int r) { return noise(c, r); });
    const int count = static_cast<int>(40 * kStep / step);
    // Posts at the middle of cells: on the fine lattice where they can be.
    const double corner = kWest + 40 * kStep + kStep / 2 - step / 2 + 50;
    add_raster({corner, kNorth - kStep / 2 + step / 2, step, count, count, 27700},
               [&](int c, int r) { return noise(c, r) + 7; });
    EXPECT_FALSE(compare(Window::all()));
    EXPECT_TRUE(compare(Window::disc({kWest + 700, kNorth - 900}, 600)));
    for (int k = 0; k < 30; ++k) compare(random_window(80 * kStep));
  }
}

TEST_F(TriangulateLattice, AsManyPostsBetweenItsPlacesAreNone) {
  const auto absent = [](int c, int r) { return c >= 20 && c < 25 && r >= 30 && r < 35; };
  add_raster({kWest, kNorth, kStep, 60, 60, 27700}, [&](int c, int r) { return absent(c, r) ? NAN : noise(c, r); });
  add_raster({kWest + 20 * kStep + 5, kNorth - 30 * kStep - 5, kStep, 5, 5, 27700},
             [&](int c, int r) { return noise(c + 20, r + 30); });
  const Store store(path("s.itin"));
  for (const auto heights : {LatticeReader::Heights::kNone, LatticeReader::Heights::kAll}) {
    EXPECT_FALSE(LatticeReader::open(store, Window::all(), ThemeChoice::none(), heights, kAny, progress_));
    EXPECT_TRUE(LatticeReader::open(store, Window::disc({kWest + 700, kNorth - 500}, 300), ThemeChoice::none(), heights,
                                    kAny, progress_));
  }
}

TEST_F(TriangulateLattice, GroundWithLinesIsNone) {
  add_raster({kWest, kNorth, kStep, 30, 30, 27700}, [&](int c, int r) { return noise(c, r); });
  ImportOptions options;
  options.sources = {path("lines.geojson")};
  options.kind = ThemeKind::Breaklines;
  test::write_lines(options.sources[0], {{{{300130, 199870, 5}, {300860, 199330, 9}}}});
  import_lines(path("s.itin"), options, progress_);
  EXPECT_FALSE(compare(Window::all()));
  EXPECT_TRUE(compare(Window::disc({kWest + 1200, kNorth - 200}, 150)));
}

TEST_F(TriangulateLattice, KeepsToItsLimits) {
  add_raster({kWest, kNorth, kStep, 30, 30, 27700}, [&](int c, int r) { return noise(c, r); });
  const Store store(path("s.itin"));
  EXPECT_FALSE(triangulate_lattice(store, Window::all(), ThemeChoice::none(), 900, progress_));
  EXPECT_TRUE(triangulate_lattice(store, Window::all(), ThemeChoice::none(), 32 * 32, progress_));
  EXPECT_FALSE(triangulate_lattice(store, Window::disc({0, 0}, 100), ThemeChoice::none(), kAny, progress_));
}

}  // namespace
}  // namespace itin
