// The triangles that a path meets, against every triangle of the whole and the path's legs.
#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include <itin/cross_section.hpp>
#include <itin/error.hpp>
#include <itin/import.hpp>
#include <itin/store.hpp>
#include <itin/triangulate.hpp>

#include "support/raster_file.hpp"
#include "support/seed.hpp"
#include "support/temporary_directory.hpp"
#include "support/terrain_tin.hpp"

namespace itin {
namespace {

constexpr int kPosts = 65;
constexpr double kStep = 20, kEast = 300000, kNorth = 200000;

struct Place {
  std::int64_t x, y;
};

int side(Place a, Place b, Place c) {
  const std::int64_t area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
  return (area > 0) - (area < 0);
}
bool within_box(Place a, Place b, Place p) {
  return std::min(a.x, b.x) <= p.x && p.x <= std::max(a.x, b.x) && std::min(a.y, b.y) <= p.y &&
         p.y <= std::max(a.y, b.y);
}
bool segments_meet(Place a, Place b, Place c, Place d) {
  const int abc = side(a, b, c), abd = side(a, b, d), cda = side(c, d, a), cdb = side(c, d, b);
  if (abc * abd < 0 && cda * cdb < 0) return true;
  return (abc == 0 && within_box(a, b, c)) || (abd == 0 && within_box(a, b, d)) || (cda == 0 && within_box(c, d, a)) ||
         (cdb == 0 && within_box(c, d, b));
}

class TrianglesAlong : public testing::Test {
 protected:
  TrianglesAlong() {
    const std::vector<double> z = test::fractal_heights(kPosts, 60, 0.6, random_());
    test::write_raster(directory_.file("t.tif"), {kEast, kNorth, kStep, kPosts, kPosts, 27700}, [&](int c, int r) {
      return std::hypot(c - 20, r - 40) < 6 ? NAN
                                            : z[static_cast<std::size_t>(r) * kPosts + static_cast<std::size_t>(c)];
    });
    ImportOptions options;
    options.sources = {directory_.file("t.tif")};
    import_terrain(directory_.file("t.itin"), options, progress_);
    store_.emplace(directory_.file("t.itin"));
  }

  /// On the grid, so that the slow twin is exact; often on a post.
  Point2 place() {
    const Grid& grid = store_->metadata().grid;
    std::uniform_int_distribution<int> post(-2, kPosts + 1), off(-900, 900);
    const GridBox& box = store_->metadata().bounds;
    const int step = static_cast<int>(kStep / grid.resolution);
    GridPoint p{box.xmin + post(random_) * step, box.ymin + post(random_) * step, 0};
    if (random_() % 3 != 0) p.x += off(random_), p.y += off(random_);
    const Point3 metres = grid.point(p);
    return {metres.x, metres.y};
  }

  Place units(Point2 p) const {
    const Grid& grid = store_->metadata().grid;
    return {std::llround((p.x - grid.origin.x) / grid.resolution),
            std::llround((p.y - grid.origin.y) / grid.resolution)};
  }

  bool meets(const std::vector<Point2>& path, const std::array<GridPoint, 3>& corners) const {
    std::array<Place, 3> t{};
    for (std::size_t i = 0; i < 3; ++i) t[i] = {corners[i].x, corners[i].y};
    for (std::size_t leg = 0; leg + 1 < path.size(); ++leg) {
      const Place a = units(path[leg]), b = units(path[leg + 1]);
      if (side(t[0], t[1], a) >= 0 && side(t[1], t[2], a) >= 0 && side(t[2], t[0], a) >= 0) return true;
      for (std::size_t i = 0; i < 3; ++i)
        if (segments_meet(a, b, t[i], t[(i + 1) % 3])) return true;
    }
    return false;
  }

  std::mt19937 random_{test::seed()};
  NoProgress progress_;
  test::TemporaryDirectory directory_;
  std::optional<Store> store_;
};

TEST_F(TrianglesAlong, AreThoseOfTheWholeThatThePathMeets) {
  std::size_t found = 0;
  for (const double tolerance : {0.0, 4.0}) {
    const Detail detail = Detail::tolerance(tolerance);
    const Tin whole = triangulate(*store_, Window::all(), detail, progress_);
    for (int run = 0; run < 60; ++run) {
      std::vector<Point2> path{place(), place()};
      while (random_() % 3 == 0) path.push_back(place());
      std::vector<std::array<VertexId, 3>> expected, got;
      for (std::uint32_t t = 0; t < whole.triangles.size(); ++t) {
        const auto& [a, b, c] = whole.triangles[t];
        if (meets(path, whole.corners(t))) expected.push_back({whole.id(a), whole.id(b), whole.id(c)});
      }
      const Tin along = triangles_along(*store_, path, detail, ThemeChoice::none(), progress_);
      for (const auto& [a, b, c] : along.triangles) got.push_back({along.id(a), along.id(b), along.id(c)});
      EXPECT_EQ(got, expected);
      EXPECT_EQ(along.sources.size(), along.vertices.size());
      found += got.size();
    }
  }
  EXPECT_GT(found, 0U);
}

TEST_F(TrianglesAlong, OfOnePlaceAreThoseThatHoldIt) {
  const Point2 post{kEast + 10.5 * kStep, kNorth - 10.5 * kStep};
  const Tin along = triangles_along(*store_, {post, post}, Detail::tolerance(0), ThemeChoice::none(), progress_);
  EXPECT_GE(along.triangles.size(), 1U);
  EXPECT_LE(along.triangles.size(), 8U);
  EXPECT_THROW(triangles_along(*store_, {post}, Detail::tolerance(0), ThemeChoice::none(), progress_), InputError);
}

}  // namespace
}  // namespace itin
