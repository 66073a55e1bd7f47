// Cell for cell against a brute-force line of sight on the same triangles.
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include <itin/parallel.hpp>
#include <viewshed/viewshed.hpp>

#include "scene/rays/scene.hpp"
#include "support/delaunay_tin.hpp"
#include "support/exact_line_of_sight.hpp"
#include "support/real_terrain.hpp"
#include "support/seed.hpp"
#include "support/terrain_tin.hpp"

namespace itin::viewshed {
namespace {

/// Rounding of double precision in the exact side, metres; a hidden cell lies at least kGrazing behind.
constexpr double kExactness = 1e-7;

struct Agreement {
  std::uint64_t cells = 0;
  std::uint64_t visible = 0;
};

/// One observer. Every cell's value must follow from the exact clearance.
Agreement compare(const Tin& tin, const Request& request) {
  NoProgress progress;
  const Result result = compute(tin, request, progress);
  const test::ExactLineOfSight exact(tin, request.earth);
  const Observer& observer = request.observers.front();
  const double base = observer.absolute ? 0 : exact.height(observer.position).value();
  const Point3 from{observer.position.x, observer.position.y, base + observer.height};
  Agreement agreement;
  for (std::int64_t row = 0; row < result.grid.rows(); ++row) {
    for (std::int64_t column = 0; column < result.grid.columns(); ++column) {
      const Point2 centre = result.grid.centre(column, row);
      const Verdict value = result.visible[result.grid.index({column, row})];
      const double distance = std::hypot(centre.x - from.x, centre.y - from.y);
      if (request.radius && distance > *request.radius) {
        EXPECT_EQ(value, Verdict::kOutside);
        continue;
      }
      const auto ground = exact.height(centre);
      if (value == Verdict::kOutside) {
        EXPECT_FALSE(exact.height(centre, -1e-6)) << "no value at " << centre.x << "," << centre.y;
        continue;
      }
      if (!ground) {
        ADD_FAILURE() << "a value without data at " << centre.x << "," << centre.y;
        continue;
      }
      const Point3 to{centre.x, centre.y, *ground + request.target_height};
      const double clearance = distance == 0 ? 0 : exact.clearance(from, to);
      ++agreement.cells;
      agreement.visible += value == Verdict::kVisible ? 1U : 0U;
      if (value == Verdict::kHidden) {
        EXPECT_LT(clearance, -kGrazing + kExactness) << "visible cell lost at " << centre.x << "," << centre.y;
      } else {
        EXPECT_GT(clearance, -kGrazing - kExactness) << "hidden cell seen at " << centre.x << "," << centre.y;
      }
    }
  }
  return agreement;
}

Request request_from(Point2 position, double height, double target_height, double cell) {
  Request request;
  request.observers = {{"o", position, height}};
  request.target_height = target_height;
  request.cell_size = cell;
  return request;
}

void expect_exact(const Agreement& agreement) {
  EXPECT_GT(agreement.cells, 0U);
  EXPECT_GT(agreement.visible, 0U);
  EXPECT_LT(agreement.visible, agreement.cells);
}

TEST(Exactness, RandomTins) {
  std::mt19937 random(test::seed());
  for (int i = 0; i < 6; ++i) {
    const Tin tin = test::random_tin(random, 400, 0, {{500000, 4000000}, 0.01}, 50000);
    const Point3 v = tin.point(static_cast<std::uint32_t>(random() % tin.vertices.size()));
    expect_exact(compare(tin, request_from({v.x, v.y}, i % 2 == 0 ? 2 : 0.1, i % 3 == 0 ? 0 : 1, 15)));
  }
}

TEST(Exactness, FractalTerrainWithEveryTargetHeight) {
  const std::uint32_t seed = test::seed();
  const Tin tin = test::fractal_tin(33, 50, 150, 0.55, seed);
  const Point2 middle{300000 + 801.3, 200000 + 777.7};
  for (const double target : {0.0, 0.5, 2.0, 20.0}) expect_exact(compare(tin, request_from(middle, 10, target, 40)));
}

TEST(Exactness, CurvatureOverLongEdges) {
  // Posts 4 km apart: the scene must cut its edges, the answer must not show it.
  const Tin tin = test::fractal_tin(17, 4000, 60, 0.5, test::seed());
  const Point2 middle{300000 + 31234.5, 200000 + 33456.7};
  for (const double k : {0.13, 0.0, -0.5, 0.9}) {
    Request request = request_from(middle, 40, 2, 1500);
    request.earth.refraction = k;
    expect_exact(compare(tin, request));
  }
}

/// A triangle that hides the corners of a block hides all of it, curvature included.
TEST(Exactness, BlocksHiddenTogetherAreHidden) {
  std::mt19937 random(test::seed());
  const Tin tin = test::fractal_tin(33, 2000, 300, 0.55, random());
  const Earth earth;
  const Scene scene(tin, earth);
  const test::ExactLineOfSight exact(tin, earth);
  const double unit = tin.grid.resolution, drop = earth.drop_coefficient();
  const auto in = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
  const auto units = [&](double x, double y) {
    return Point2{(x - tin.grid.origin.x) / unit, (y - tin.grid.origin.y) / unit};
  };
  int hidden = 0;
  for (int i = 0; i < 100; ++i) {
    const Point2 eye{300000 + in(20000, 44000), 200000 + in(20000, 44000)};
    const double elevation = exact.height(eye).value() + 20;
    SightLines lines;
    lines.start_at({units(eye.x, eye.y).x, units(eye.x, eye.y).y, elevation / unit});
    std::array<Box, 4> boxes;
    std::array<double, 4> level{};  // less the drop
    for (unsigned q = 0; q < 4; ++q) {
      const double x = 300000 + in(100, 58000), y = 200000 + in(100, 58000);
      boxes[q] = {x, y, x + in(1, 1500), y + in(1, 1500)};
      if (boxes[q].contains(eye)) continue;
      level[q] = elevation + in(-300, 100);
      for (unsigned k = 0; k < 4; ++k) {
        const Point2 p{k % 2 == 0 ? boxes[q].xmin : boxes[q].xmax, k < 2 ? boxes[q].ymin : boxes[q].ymax};
        const unsigned line = 4 * q + k;
        lines.to_x[line] = units(p.x, p.y).x, lines.to_y[line] = units(p.x, p.y).y;
        lines.to_z[line] = (level[q] + drop * std::pow(std::hypot(p.x - eye.x, p.y - eye.y), 2) + 1e-5) / unit;
        lines.active |= 1U << line;
      }
    }
    Occluder occluder;
    const unsigned together = scene.hidden_together(lines, occluder);
    for (unsigned q = 0; q < 4; ++q) {
      if ((together >> q & 1) == 0) continue;
      ++hidden;
      for (int k = 0; k < 8; ++k) {
        const Point2 p{in(boxes[q].xmin, boxes[q].xmax), in(boxes[q].ymin, boxes[q].ymax)};
        const double z = level[q] + drop * std::pow(std::hypot(p.x - eye.x, p.y - eye.y), 2) - (k % 2) * in(0, 50);
        EXPECT_LT(exact.clearance({eye.x, eye.y, elevation}, {p.x, p.y, z}), 0) << p.x << ' ' << p.y << ' ' << z;
      }
    }
  }
  EXPECT_GT(hidden, 10);
}

TEST(Exactness, ObserversOnVerticesEdgesAndCellCorners) {
  const Tin tin = test::fractal_tin(33, 50, 100, 0.55, test::seed());
  const Point2 corner{300000, 200000};
  for (const Point2 offset : {Point2{800, 800}, Point2{825, 800}, Point2{800, 812}, Point2{825, 825},
                              Point2{812.5, 812.5}, Point2{0, 0}, Point2{1600, 800}, Point2{1600, 1600}}) {
    expect_exact(compare(tin, request_from({corner.x + offset.x, corner.y + offset.y}, 5, 0, 50)));
  }
}

TEST(Exactness, ThinPillarsOnAPlane) {
  // A pillar 1 m wide and 40 m high every 200 m; between them cells must be seen again behind each.
  const Tin tin = test::lattice_tin(
      401, 401, 1, [](std::int32_t c, std::int32_t r) { return c % 100 == 50 && r % 100 == 50 ? 40.0 : 0.0; });
  Request request = request_from({300000 + 201.3, 200000 + 198.9}, 10, 1, 4);
  request.radius = 190;
  NoProgress progress;
  const Result result = compute(tin, request, progress);
  const auto at = [&](double x, double y) { return result.visible[result.grid.index(*result.grid.cell_at({x, y}))]; };
  EXPECT_EQ(at(300000 + 126, 200000 + 126), Verdict::kHidden);  // right behind the pillar at 150, 150
  EXPECT_EQ(at(300000 + 150, 200000 + 130), Verdict::kVisible);
  // The twin tests every triangle for every cell: a smaller piece, with the same pillars.
  const Tin piece = test::lattice_tin(
      61, 61, 1, [](std::int32_t c, std::int32_t r) { return c % 20 == 10 && r % 20 == 10 ? 40.0 : 0.0; });
  expect_exact(compare(piece, request_from({300000 + 31.3, 200000 + 28.9}, 10, 1, 2)));
  expect_exact(compare(piece, request_from({300000 + 30.5, 200000 + 30.5}, 1, 0, 2)));
}

TEST(Exactness, HolesLetSightLinesPass) {
  std::mt19937 random(test::seed());
  const Tin tin = test::random_tin(random, 500, 0.1, {{0, 0}, 0.01}, 50000);
  const Triangle& t = tin.triangles[tin.triangles.size() / 2];
  const Point3 a = tin.point(t[0]), b = tin.point(t[1]), c = tin.point(t[2]);
  Request request = request_from({(a.x + b.x + c.x) / 3, (a.y + b.y + c.y) / 3}, 2, 1, 20);
  request.nodata = NoData::kClear;
  expect_exact(compare(tin, request));
}

TEST(Exactness, RealTerrain) {
  const auto tin = test::big_tujunga(300, 300, 40);
  if (!tin) GTEST_SKIP() << "needs " << test::big_tujunga_path();
  const Box box = tin->bounds();
  for (const double target : {0.0, 2.0}) {
    Request request = request_from({box.xmin + 0.47 * box.width(), box.ymin + 0.55 * box.height()}, 10, target, 30);
    expect_exact(compare(*tin, request));
  }
}

}  // namespace
}  // namespace itin::viewshed
