// Law 2 against brute force on real terrain: the difference between the full surface and a coarse one, at every vertex
// of the overlay of both, lies within the certificates of every box that holds it.
#include <filesystem>
#include <optional>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include <itin/import.hpp>
#include <itin/store.hpp>
#include <itin/triangulate.hpp>

#include "support/raster_file.hpp"
#include "support/seed.hpp"
#include "support/temporary_directory.hpp"
#include "support/vector_file.hpp"

namespace itin {
namespace {

struct Sample {
  Point2 position;
  double difference;
};

double cross(Point2 a, Point2 b, Point2 c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}
Point2 flat(const Point3& p) {
  return {p.x, p.y};
}

/// Height of a Tin at a point, by looking at every triangle.
std::optional<double> height_at(const Tin& tin, Point2 p) {
  for (const Triangle& t : tin.triangles) {
    const Point3 a = tin.point(t[0]), b = tin.point(t[1]), c = tin.point(t[2]);
    const double wa = cross(flat(b), flat(c), p), wb = cross(flat(c), flat(a), p), wc = cross(flat(a), flat(b), p);
    if (wa >= 0 && wb >= 0 && wc >= 0) return (wa * a.z + wb * b.z + wc * c.z) / (wa + wb + wc);
  }
  return std::nullopt;
}

std::set<std::pair<std::uint32_t, std::uint32_t>> edges_of(const Tin& tin) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (const Triangle& t : tin.triangles) {
    for (std::size_t i = 0; i < 3; ++i) edges.insert(std::minmax(t[i], t[(i + 1) % 3]));
  }
  return edges;
}

std::vector<Sample> overlay(const Tin& fine, const Tin& coarse) {
  std::vector<Sample> samples;
  for (std::uint32_t v = 0; v < fine.vertices.size(); ++v) {
    const Point3 p = fine.point(v);
    const auto h = height_at(coarse, flat(p));
    EXPECT_TRUE(h.has_value()) << "the coarse surface does not cover " << p.x << " " << p.y;
    if (h) samples.push_back({flat(p), p.z - *h});
  }
  const auto coarse_edges = edges_of(coarse);
  for (const auto& [u, v] : edges_of(fine)) {
    const Point3 a = fine.point(u), b = fine.point(v);
    for (const auto& [w, x] : coarse_edges) {
      const Point3 c = coarse.point(w), d = coarse.point(x);
      if (std::max(a.x, b.x) < std::min(c.x, d.x) || std::max(c.x, d.x) < std::min(a.x, b.x)) continue;
      const double ca = cross(flat(c), flat(d), flat(a)), cb = cross(flat(c), flat(d), flat(b));
      const double ac = cross(flat(a), flat(b), flat(c)), ad = cross(flat(a), flat(b), flat(d));
      if (ca * cb >= 0 || ac * ad >= 0) continue;
      const double s = ca / (ca - cb), t = ac / (ac - ad);
      samples.push_back(
          {{a.x + s * (b.x - a.x), a.y + s * (b.y - a.y)}, a.z + s * (b.z - a.z) - c.z - t * (d.z - c.z)});
    }
  }
  return samples;
}

void expect_certified(const Store& store, unsigned seed) {
  std::mt19937 random(seed);
  NoProgress progress;
  const Tin fine = triangulate(store, Window::all(), Detail::tolerance(0), progress);
  const Box bounds = fine.bounds();
  for (std::size_t k = 1; k < store.metadata().levels.size(); ++k) {
    const LevelInfo& level = store.metadata().levels[k];
    EXPECT_GE(level.certified_error.lo, -level.tolerance);
    EXPECT_LE(level.certified_error.hi, level.tolerance);
    const Tin coarse = triangulate(store, Window::all(), Detail::tolerance(level.tolerance), progress);
    const std::vector<Sample> samples = overlay(fine, coarse);
    double lo = 0, hi = 0;
    for (const Sample& s : samples) lo = std::min(lo, s.difference), hi = std::max(hi, s.difference);
    // Tight, too: the level's certificate is no wider than its worst sample, but for rounding to the grid.
    EXPECT_NEAR(level.certified_error.lo, lo, 0.0101) << "level " << k;
    EXPECT_NEAR(level.certified_error.hi, hi, 0.0101) << "level " << k;
    for (int i = 0; i < 200; ++i) {
      const auto in = [&](double low, double high) {
        return low + (high - low) * static_cast<double>(random() % 1000) / 1000;
      };
      const double x = in(bounds.xmin, bounds.xmax), y = in(bounds.ymin, bounds.ymax), side = in(1, 1500);
      const Box box{x, y, x + side, y + side};
      const auto certified = store.certified_error(static_cast<int>(k), box);
      for (const Sample& s : samples) {
        if (!box.contains(s.position)) continue;
        ASSERT_TRUE(certified.has_value());
        ASSERT_GE(s.difference, certified->lo - 1e-7) << "level " << k << ", seed " << seed;
        ASSERT_LE(s.difference, certified->hi + 1e-7) << "level " << k << ", seed " << seed;
      }
    }
  }
}

TEST(Certificate, HoldsOnRealTerrainWithAndWithoutVoids) {
  const test::TemporaryDirectory directory;
  const test::CardiffTerrain terrain;
  const auto none = [](int, int) { return false; };
  const auto round = [](int c, int r) { return (c - 20) * (c - 20) + (r - 25) * (r - 25) < 40; };
  // Pieces of ground that meet only at a post.
  const auto ragged = [](int c, int r) { return (c * 7919 + r * 104729 + c * r * 31) % 10 < 4; };
  for (const std::function<bool(int, int)>& is_void : std::vector<std::function<bool(int, int)>>{none, round, ragged}) {
    const std::string raster = directory.file("t.tif"), path = directory.file("t.itin");
    std::filesystem::remove(path);
    test::write_raster(raster, {300000, 200000, 50, 46, 44, 27700},
                       [&](int c, int r) { return is_void(c, r) ? std::nan("") : terrain(c + 150, r + 250); });
    ImportOptions options;
    options.sources = {raster};
    NoProgress progress;
    import_terrain(path, options, progress);
    expect_certified(Store(path), test::seed());
  }
}

TEST(Certificate, HoldsWithLinesOfTheTerrain) {
  std::mt19937 random(test::seed());
  const auto in = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random() % 100000) / 100000;
  };
  const test::TemporaryDirectory directory;
  const test::CardiffTerrain terrain;
  for (const bool cliffs : {false, true}) {
    const std::string raster = directory.file("t.tif"), lines = directory.file("l.geojson"),
                      path = directory.file("t.itin");
    std::filesystem::remove(path);
    test::write_raster(raster, {300000, 200000, 50, 36, 34, 27700},
                       [&](int c, int r) { return terrain(c + 150, r + 250); });
    // Winding lines on the terrain, and some that are far above it and below.
    std::vector<test::LineFeature> features;
    for (int i = 0; i < 8; ++i) {
      test::LineFeature f;
      Point3 p{in(300300, 301500), in(198500, 199700), 0};
      double heading = in(0, 6.28);
      for (int k = 0; k < 40; ++k) {
        const double ground =
            terrain(static_cast<int>((p.x - 300000) / 50) + 150, static_cast<int>((200000 - p.y) / 50) + 250);
        f.vertices.push_back({p.x, p.y, ground + (cliffs ? in(-20, 20) : 0)});
        heading += in(-0.7, 0.7);
        p = {p.x + 12 * std::cos(heading), p.y + 12 * std::sin(heading), 0};
      }
      features.push_back(f);
    }
    test::write_lines(lines, features);
    ImportOptions options;
    options.sources = {raster};
    NoProgress progress;
    import_terrain(path, options, progress);
    options.sources = {lines};
    options.kind = ThemeKind::Breaklines;
    import_lines(path, options, progress);
    expect_certified(Store(path), test::seed());
  }
}

}  // namespace
}  // namespace itin
