// Sweeps about upright axes against searches line by line, and the bounds that they rest on against the surface.
#include "axis_sweep.hpp"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>
#include <random>

#include <gtest/gtest.h>

#include "boundary.hpp"
#include "least_height.hpp"
#include "support/delaunay_tin.hpp"
#include "support/exact_line_of_sight.hpp"
#include "support/real_terrain.hpp"
#include "support/seed.hpp"
#include "support/terrain_tin.hpp"

namespace itin::viewshed {
namespace {

struct Tally {
  int seen = 0, hidden = 0, partly = 0;
};

/// Every cell of a grid over a Tin, tile by tile, with its ground raised.
class RaisedGround {
 public:
  RaisedGround(const Tin& tin, double cell)
      : tin_(tin),
        grid_(RasterGrid::aligned(tin.bounds(), cell)),
        tiles_(grid_of_tiles(grid_)),
        in_tiles_(tin, tiles_) {}

  /// Calls visit(ends) for every tile; `above` is in metres.
  template <class Visit>
  void for_each_tile(double above, const Visit& visit) const {
    const auto elevation = std::make_unique<TileValues<double>>();
    for (std::size_t i = 0; i < tiles_.cell_count(); ++i) {
      const Tile tile = tile_at(grid_, tiles_, i);
      const TileCentres centres(tin_.grid, grid_, tile);
      scan_convert(tin_, in_tiles_.triangles(i), tile, centres, *elevation);
      for (double& z : *elevation) z += above / tin_.grid.resolution;
      visit(AxisSweep::Ends{tile, centres, *elevation});
    }
  }

 private:
  const Tin& tin_;
  RasterGrid grid_;
  RasterGrid tiles_;
  TriangleBins in_tiles_;
};

/// Every cell of a grid over the Tin, as tiles see it, looking at one axis.
class Sweeping {
 public:
  Sweeping(const Tin& tin, const Earth& earth, double cell)
      : tin_(tin),
        earth_(earth),
        bins_(tin),
        sweep_(tin, earth, bins_),
        scene_(tin, earth, NoData::kClear, 0),
        heights_(tin, earth, scene_),
        exact_(tin, earth),
        ground_(tin, cell) {}

  /// Metres.
  Tally compare(Point2 foot, double height, double eye_height, double radius) {
    Tally tally;
    const auto base = exact_.height(foot);
    if (!base) return tally;
    const double unit = tin_.grid.resolution;
    const AxisSweep::Axis axis{easting_in_units(tin_.grid, foot.x), northing_in_units(tin_.grid, foot.y), *base / unit,
                               (*base + height) / unit, radius / unit};
    const auto work = std::make_unique<Work>();
    ground_.for_each_tile(eye_height, [&](const AxisSweep::Ends& eyes) {
      sweep_.run(axis, eyes, work->scratch, work->found);
      for (std::int64_t r = 0; r < eyes.tile.rows; ++r)
        for (std::int64_t c = 0; c < eyes.tile.columns; ++c) check(axis, eyes, work->found, r, c, tally);
    });
    return tally;
  }

 private:
  struct Work {
    AxisSweep::Heights found;
    AxisSweep::Scratch scratch;
  };

  void check(const AxisSweep::Axis& axis, const AxisSweep::Ends& eyes, const AxisSweep::Heights& heights,
             std::int64_t row, std::int64_t column, Tally& tally) {
    const auto cell = static_cast<std::size_t>(row * Tile::kSide + column);
    const double eye = eyes.elevation[cell];
    if (std::isnan(eye)) return;
    const double x = eyes.centres.x[static_cast<std::size_t>(column)],
                 y = eyes.centres.y[static_cast<std::size_t>(row)];
    const double distance = std::hypot(x - axis.x, y - axis.y), found = heights[cell];
    if (distance == 0 || distance > axis.radius * (1 + 1e-9)) {
      EXPECT_TRUE(std::isinf(found)) << "an eye that does not look";
      return;
    }
    if (distance > axis.radius * (1 - 1e-9)) return;
    SightLines line;
    line.from_x[0] = x, line.from_y[0] = y, line.from_z[0] = eye;
    line.to_x[0] = axis.x, line.to_y[0] = axis.y, line.to_z[0] = axis.top, line.active = 1;
    LeastHeights::Heights lower{};
    lower[0] = axis.base;
    LeastHeights::Memory memory;
    const double expected = heights_.find(line, lower, memory)[0];
    ++(std::isnan(expected) ? tally.hidden : tally.seen);
    if (std::isnan(expected) != std::isnan(found)) {
      const double unit = tin_.grid.resolution;
      const Point3 from{tin_.grid.origin.x + x * unit, tin_.grid.origin.y + y * unit, eye * unit};
      const Point3 to{tin_.grid.origin.x + axis.x * unit, tin_.grid.origin.y + axis.y * unit, axis.top * unit};
      EXPECT_NEAR(exact_.clearance(from, to), -kGrazing, 1e-7) << x << ", " << y << " found " << found;
    } else if (!std::isnan(expected)) {
      EXPECT_NEAR(found, expected, 1e-4) << x << ", " << y;
      if (found > axis.base + 1) ++tally.partly;
    }
  }

  const Tin& tin_;
  Earth earth_;
  BinnedHeights bins_;
  AxisSweep sweep_;
  Scene scene_;
  LeastHeights heights_;
  test::ExactLineOfSight exact_;
  RaisedGround ground_;
};

Point2 place_in(const Tin& tin, std::mt19937& random) {
  const Box box = tin.bounds();
  std::uniform_real_distribution<double> share(0.02, 0.98);
  const double x = share(random);
  return {box.xmin + x * box.width(), box.ymin + share(random) * box.height()};
}

TEST(AxisSweep, RandomTins) {
  std::mt19937 random(test::seed());
  Tally all;
  for (int i = 0; i < 6; ++i) {
    const Tin tin = test::random_tin(random, 300, i % 2 == 0 ? 0 : 0.1, {{500000, 4000000}, 0.01}, 50000);
    const double size = std::max(tin.bounds().width(), tin.bounds().height());
    Sweeping sweeping(tin, {}, size / (i < 2 ? 10 : 150));
    const Tally t = sweeping.compare(place_in(tin, random), 20, i % 3 == 0 ? 0 : 2, size * (i % 2 == 0 ? 2 : 0.4));
    all.seen += t.seen, all.hidden += t.hidden, all.partly += t.partly;
  }
  EXPECT_GT(all.hidden, 100);
  EXPECT_GT(all.partly, 100);
}

TEST(AxisSweep, FractalTerrainWithCellsOfEverySize) {
  std::mt19937 random(test::seed());
  int hidden = 0;
  for (const double roughness : {0.35, 0.5, 0.65}) {
    const Tin tin = test::fractal_tin(65, 50, 150, roughness, random());
    for (const double cell : {23.0, 50.0, 170.0}) {
      Sweeping sweeping(tin, {}, cell);
      hidden += sweeping.compare(place_in(tin, random), 120, 2, 2000).hidden;
      // On a post, and so on cells' corners and diagonals.
      EXPECT_GT(sweeping.compare({300000 + 50 * 20, 200000 + 50 * 31}, 60, 0, 5000).seen, 0);
    }
  }
  EXPECT_GT(hidden, 0);
}

TEST(AxisSweep, GroundWithVoids) {
  std::mt19937 random(test::seed());
  const std::vector<double> z = test::fractal_heights(65, 120, 0.5, random());
  const Tin tin = test::lattice_tin(65, 65, 50, [&](std::int32_t c, std::int32_t r) {
    const bool bare = (c / 9 + r / 9) % 4 == 0 || std::hypot(c - 32, r - 32) > 31;
    return bare ? NAN : z[static_cast<std::size_t>(r) * 65 + static_cast<std::size_t>(c)];
  });
  Sweeping sweeping(tin, {}, 37);
  Tally all;
  for (int i = 0; i < 6; ++i) {
    const Tally t = sweeping.compare(place_in(tin, random), 90, 2, 5000);
    all.seen += t.seen, all.hidden += t.hidden;
  }
  EXPECT_GT(all.seen, 0);
  EXPECT_GT(all.hidden, 0);
}

TEST(AxisSweep, LongEdgesOnACurvedEarth) {
  std::mt19937 random(test::seed());
  const Tin tin = test::fractal_tin(17, 4000, 60, 0.5, random());
  int partly = 0;
  for (const double k : {0.13, -0.5, 0.9}) {
    Earth earth;
    earth.refraction = k;
    Sweeping sweeping(tin, earth, 900);
    partly += sweeping.compare(place_in(tin, random), 200, 2, 60000).partly;
  }
  EXPECT_GT(partly, 50);
}

TEST(AxisSweep, WallsAndRoofs) {
  // Boxes with walls a centimetre thick, among which eyes and axis may stand.
  const Tin tin = test::lattice_tin(
      161, 161, 5, [](std::int32_t c, std::int32_t r) { return c % 7 < 3 && r % 11 < 4 ? 9.0 + c % 5 : 0.01 * c; });
  Sweeping sweeping(tin, {}, 7);
  std::mt19937 random(test::seed());
  const Tally t = sweeping.compare(place_in(tin, random), 60, 2, 700);
  EXPECT_GT(t.partly, 100);
  EXPECT_GT(t.hidden, 0);
}

TEST(AxisSweep, RealTerrain) {
  const auto tin = test::big_tujunga(300, 300, 60);
  if (!tin) GTEST_SKIP() << "needs " << test::big_tujunga_path();
  std::mt19937 random(test::seed());
  Sweeping sweeping(*tin, {}, 20);
  int hidden = 0;
  for (int i = 0; i < 4; ++i) hidden += sweeping.compare(place_in(*tin, random), 150, 2, 5000).hidden;
  EXPECT_GT(hidden, 50);
}

/// Every cell of a grid over the Tin as an eye sees it, against the line over every triangle: to the last bit.
Tally look_around(const Tin& tin, const Earth& earth, const Point3& eye, double target_height, double cell) {
  const BinnedHeights bins(tin);
  const AxisSweep sweep(tin, earth, bins);
  struct Work {
    AxisSweep::Heights seen;
    AxisSweep::Scratch scratch;
  };
  const auto work = std::make_unique<Work>();
  const double unit = tin.grid.resolution;
  Tally tally;
  RaisedGround(tin, cell).for_each_tile(target_height, [&](const AxisSweep::Ends& targets) {
    sweep.look_from(eye, targets, work->scratch, work->seen);
    for (std::size_t k = 0; k < targets.elevation.size(); ++k) {
      if (std::isnan(targets.elevation[k])) continue;
      const Point3 target{targets.centres.x[k % Tile::kSide], targets.centres.y[k / Tile::kSide], targets.elevation[k]};
      if (target.x == eye.x && target.y == eye.y) continue;
      const SightLine line(eye, target, earth.drop_coefficient() * unit, kGrazing / unit);
      const bool hidden = std::any_of(tin.triangles.begin(), tin.triangles.end(), [&](const Triangle& t) {
        return line.hidden_by(tin.vertices[t[0]], tin.vertices[t[1]], tin.vertices[t[2]]);
      });
      EXPECT_EQ(std::isnan(work->seen[k]), hidden) << "at " << target.x << ", " << target.y;
      ++(hidden ? tally.hidden : tally.seen);
    }
  });
  return tally;
}

Point3 above(const Tin& tin, Point2 position, double height) {
  const double unit = tin.grid.resolution;
  return {easting_in_units(tin.grid, position.x), northing_in_units(tin.grid, position.y),
          (height_on(tin, position).value_or(0) + height) / unit};
}

TEST(AxisSweep, AnEyeSeesWhatTheWalkOverEveryTriangleSays) {
  std::mt19937 random(test::seed());
  const std::vector<double> z = test::fractal_heights(33, 60, 0.5, random());
  const Tin lattice = test::lattice_tin(33, 33, 50, [&](std::int32_t c, std::int32_t r) {
    return (c / 5 + r / 5) % 5 == 0 ? NAN : z[static_cast<std::size_t>(r) * 33 + static_cast<std::size_t>(c)];
  });
  const Tin walls = test::lattice_tin(
      41, 41, 5, [](std::int32_t c, std::int32_t r) { return c % 7 < 2 && r % 11 < 4 ? 9.0 + c % 5 : 0.01 * c; });
  const Tin scattered = test::random_tin(random, 300, 0.1, {{500000, 4000000}, 0.01}, 50000);
  Tally all;
  for (const Tin* tin : {&lattice, &walls, &scattered}) {
    const Box box = tin->bounds();
    for (const double height : {2.0, 30.0}) {
      const Tally t = look_around(*tin, {}, above(*tin, place_in(*tin, random), height), height == 2 ? 0 : 2,
                                  std::max(box.width(), box.height()) / 48);
      all.seen += t.seen, all.hidden += t.hidden;
    }
    // On a vertex, and so on corners and edges of bins; and from outside.
    const Point3 vertex = tin->point(static_cast<std::uint32_t>(random() % tin->vertices.size()));
    look_around(*tin, {}, above(*tin, {vertex.x, vertex.y}, 3), 1, box.width() / 32);
    look_around(*tin, {}, above(*tin, {box.xmin - 0.3 * box.width(), box.ymax + 2 * box.height()}, 90), 1,
                box.width() / 32);
  }
  EXPECT_GT(all.seen, 100);
  EXPECT_GT(all.hidden, 100);
}

TEST(AxisSweep, AnEyeSeesAlongBentLines) {
  std::mt19937 random(test::seed());
  const Tin tin = test::fractal_tin(17, 4000, 60, 0.5, random());
  for (const double k : {0.13, -0.5, 0.9, 1.4, 3.0}) {
    Earth earth;
    earth.refraction = k;
    look_around(tin, earth, above(tin, place_in(tin, random), 40), 2, 1100);
  }
}

void expect_bounds(const Tin& tin, std::mt19937& random) {
  const BinnedHeights bins(tin);
  const test::ExactLineOfSight exact(tin, {});
  std::uniform_real_distribution<double> share(0, 1);
  const Box box = tin.bounds();
  const double unit = tin.grid.resolution;
  int looked = 0;
  for (int i = 0; i < 6000; ++i) {
    const Point2 p{box.xmin + share(random) * box.width(), box.ymin + share(random) * box.height()};
    const double column = bins.column_at((p.x - tin.grid.origin.x) / unit);
    const double row = bins.row_at((p.y - tin.grid.origin.y) / unit);
    const RasterGrid::Cell bin{static_cast<std::int64_t>(column), static_cast<std::int64_t>(row)};
    const auto& east = bins.eastwards();
    const auto run = static_cast<std::size_t>(bin.row * east.a_line + bin.column / BinnedHeights::kRun);
    const auto height = exact.height(p);
    if (!height) {
      EXPECT_EQ(east.low[run], -INFINITY);
      continue;
    }
    ++looked;
    const double z = *height / unit;
    EXPECT_LE(z, bins.lid(bin, column, row) + 1e-6);
    EXPECT_LE(z, east.high[run] + 1e-6);
    EXPECT_GE(z, east.low[run] - 1e-6);
    const auto& south = bins.southwards();
    const auto down = static_cast<std::size_t>(bin.column * south.a_line + bin.row / BinnedHeights::kRun);
    EXPECT_LE(z, south.high[down] + 1e-6);
    EXPECT_GE(z, south.low[down] - 1e-6);
  }
  EXPECT_GT(looked, 1000);
}

TEST(BinnedHeights, LidsAndRunsHoldAtEveryPointOfABin) {
  std::mt19937 random(test::seed());
  expect_bounds(test::random_tin(random, 400, 0.1, {{500000, 4000000}, 0.01}, 50000), random);
  const std::vector<double> z = test::fractal_heights(33, 60, 0.5, random());
  expect_bounds(test::lattice_tin(33, 33, 50,
                                  [&](std::int32_t c, std::int32_t r) {
                                    return (c / 5 + r / 5) % 5 == 0
                                               ? NAN
                                               : z[static_cast<std::size_t>(r) * 33 + static_cast<std::size_t>(c)];
                                  }),
                random);
}

}  // namespace
}  // namespace itin::viewshed
