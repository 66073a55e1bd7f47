// Sweeps about upright axes and from eyes against all triangles, line by line, and the bounds that they rest on against
// the surface.
#include "scene/sweep/radial_sweep.hpp"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>
#include <random>

#include <gtest/gtest.h>

#include <itin/grid_units.hpp>
#include <itin/same_place.hpp>

#include "bounds/boundary.hpp"
#include "bounds/surface_heights.hpp"
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
      visit(RadialSweep::Ends{tile, centres, *elevation});
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
  /// Metres.
  Sweeping(const Tin& tin, const Earth& earth, double cell)
      : tin_(tin), earth_(earth), bins_(tin), sweep_(earth, bins_), exact_(tin, earth), ground_(tin, cell) {
    const Box box = tin.bounds();
    every_ = 1 + static_cast<std::int64_t>(box.width() * box.height() / (cell * cell) *
                                           static_cast<double>(tin.triangles.size()) / 3e6);
  }

  /// Metres.
  Tally compare(Point2 foot, double height, double eye_height, double radius) {
    Tally tally;
    const auto base = exact_.height(foot);
    if (!base) return tally;
    const double unit = tin_.grid.resolution;
    const RadialSweep::Axis axis{easting_in_units(tin_.grid, foot.x), northing_in_units(tin_.grid, foot.y),
                                 *base / unit, (*base + height) / unit, radius / unit};
    const auto work = std::make_unique<Work>();
    const RadialSweep::View view = sweep_.view_of(axis);
    ground_.for_each_tile(eye_height, [&](const RadialSweep::Ends& eyes) {
      sweep_.run(view, eyes, work->scratch, work->found);
      for (std::int64_t r = 0; r < eyes.tile.rows; ++r)
        for (std::int64_t c = (r * 7) % every_; c < eyes.tile.columns; c += every_)
          check(axis, eyes, work->found, r, c, tally);
    });
    return tally;
  }

 private:
  struct Work {
    RadialSweep::Heights found;
    RadialSweep::Scratch scratch;
  };

  void check(const RadialSweep::Axis& axis, const RadialSweep::Ends& eyes, const RadialSweep::Heights& heights,
             std::int64_t row, std::int64_t column, Tally& tally) {
    const auto cell = static_cast<std::size_t>(row * Tile::kSide + column);
    const double eye = eyes.elevation[cell];
    if (std::isnan(eye)) return;
    const double x = eyes.centres.x[static_cast<std::size_t>(column)],
                 y = eyes.centres.y[static_cast<std::size_t>(row)];
    const double distance = std::hypot(x - axis.x, y - axis.y), found = heights[cell];
    if (same_place(distance, 0) || distance > axis.radius * (1 + 1e-9)) {
      EXPECT_TRUE(std::isinf(found)) << "an eye that does not look";
      return;
    }
    if (distance > axis.radius * (1 - 1e-9)) return;
    const double expected = least({x, y, eye}, axis);
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

  /// Grid units; the height of the axis above which an eye sees it.
  double least(const Point3& eye, const RadialSweep::Axis& axis) const {
    const double unit = tin_.grid.resolution;
    const SightLine line(eye, {axis.x, axis.y, axis.top}, earth_.drop_coefficient() * unit, kGrazing / unit);
    double least = axis.base;
    for (const Triangle& t : tin_.triangles) {
      const GridPoint &a = tin_.vertices[t[0]], &b = tin_.vertices[t[1]], &c = tin_.vertices[t[2]];
      if (line.hidden_by(a, b, c)) return NAN;
      least = std::max(least, std::min(axis.top, line.clearing_end(a, b, c)));
    }
    return least;
  }

  const Tin& tin_;
  Earth earth_;
  BinnedHeights bins_;
  RadialSweep sweep_;
  test::ExactLineOfSight exact_;
  RaisedGround ground_;
  std::int64_t every_ = 1;  ///< one in so many cells is looked at
};

Point2 place_in(const Tin& tin, std::mt19937& random) {
  const Box box = tin.bounds();
  std::uniform_real_distribution<double> share(0.02, 0.98);
  const double x = share(random);
  return {box.xmin + x * box.width(), box.ymin + share(random) * box.height()};
}

TEST(RadialSweep, RandomTins) {
  std::mt19937 random(test::seed());
  Tally all;
  for (int i = 0; i < 6; ++i) {
    const Tin tin = test::random_tin(random, 300, i % 2 == 0 ? 0 : 0.1, {{500000, 4000000}, 0.01}, 50000);
    const double size = std::max(tin.bounds().width(), tin.bounds().height());
    Sweeping sweeping(tin, {}, size / (i < 2 ? 10 : 150));
    const Tally t = sweeping.compare(place_in(tin, random), 20, i % 3 == 0 ? 0 : 2, size * (i % 2 == 0 ? 2 : 0.4));
    all.seen += t.seen, all.hidden += t.hidden, all.partly += t.partly;
  }
  EXPECT_GT(all.hidden, 20);
  EXPECT_GT(all.partly, 20);
}

TEST(RadialSweep, FractalTerrainWithCellsOfEverySize) {
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

TEST(RadialSweep, AxesOnCellCentresAndWithinStepsOfThem) {
  std::mt19937 random(test::seed());
  const Tin tin = test::fractal_tin(33, 50, 150, 0.55, random());
  constexpr double kCell = 7.93;
  Sweeping sweeping(tin, {}, kCell);
  for (const double steps : {0.0, 1e-9, 0.4, 0.9, 1.1, 3.0}) {
    const auto centre = [&](double corner) {
      const double cell = std::floor(corner / kCell) + 40 + static_cast<double>(random() % 100);
      return (cell + 0.5) * kCell + steps * tin.grid.resolution;
    };
    EXPECT_GT(sweeping.compare({centre(300000), centre(200000)}, 60, steps == 0 ? 0 : 2, 200).seen, 0);
  }
}

TEST(RadialSweep, GroundWithVoids) {
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

TEST(RadialSweep, LongEdgesOnACurvedEarth) {
  std::mt19937 random(test::seed());
  const Tin tin = test::fractal_tin(17, 4000, 60, 0.5, random());
  int partly = 0;
  for (const double k : {0.13, -0.5, 0.9}) {
    Earth earth;
    earth.refraction = k;
    Sweeping sweeping(tin, earth, 900);
    partly += sweeping.compare(place_in(tin, random), 200, 2, 60000).partly;
  }
  EXPECT_GT(partly, 10);
}

TEST(RadialSweep, WallsAndRoofs) {
  // Boxes with walls a centimetre thick, among which eyes and axis may stand.
  const Tin tin = test::lattice_tin(
      161, 161, 5, [](std::int32_t c, std::int32_t r) { return c % 7 < 3 && r % 11 < 4 ? 9.0 + c % 5 : 0.01 * c; });
  Sweeping sweeping(tin, {}, 7);
  std::mt19937 random(test::seed());
  const Tally t = sweeping.compare(place_in(tin, random), 60, 2, 700);
  EXPECT_GT(t.partly + t.hidden, 10);
}

TEST(RadialSweep, RealTerrain) {
  const auto tin = test::big_tujunga(300, 300, 60);
  if (!tin) GTEST_SKIP() << "needs " << test::big_tujunga_path();
  std::mt19937 random(test::seed());
  Sweeping sweeping(*tin, {}, 20);
  int hidden = 0;
  for (int i = 0; i < 4; ++i) hidden += sweeping.compare(place_in(*tin, random), 150, 2, 5000).hidden;
  EXPECT_GT(hidden, 5);
}

/// The lines from an eye to every cell of a grid over the Tin, against those over every triangle: to the last bit.
class LookingAround {
 public:
  LookingAround(const Tin& tin, const Earth& earth, double cell)
      : tin_(tin),
        drop_(earth.drop_coefficient() * tin.grid.resolution),
        bins_(tin),
        sweep_(earth, bins_),
        ground_(tin, cell) {}

  /// Metres above the ground.
  Tally see(const Point3& eye, double target_height) {
    Tally tally;
    const RadialSweep::View view = sweep_.view_of(sweep_.axis_at(eye, INFINITY));
    ground_.for_each_tile(target_height, [&](const RadialSweep::Ends& targets) {
      sweep_.decide(view, targets, work_->scratch, work_->found);
      for_each_line(eye, targets, [&](std::size_t cell, const SightLine& line) {
        const bool hidden = hides(line);
        EXPECT_EQ(std::isnan(work_->found[cell]), hidden) << "cell " << cell;
        ++(hidden ? tally.hidden : tally.seen);
      });
    });
    return tally;
  }

  /// How high above the ground cells are seen, if below `highest`; `wanted` is a height asked for besides.
  Tally raise(const Point3& eye, double wanted, double highest) {
    Tally tally;
    const double metre = 1 / tin_.grid.resolution;
    const RadialSweep::View view = sweep_.view_of(sweep_.axis_at(eye, INFINITY));
    ground_.for_each_tile(0, [&](const RadialSweep::Ends& ground) {
      for (std::size_t i = 0; i < ground.elevation.size(); ++i) {
        work_->wanted[i] = ground.elevation[i] + wanted * metre;
        work_->highest[i] = ground.elevation[i] + highest * metre;
      }
      sweep_.raise_from(view, {ground.tile, ground.centres, work_->highest}, {ground.elevation, work_->wanted},
                        work_->scratch, work_->found);
      for_each_line(eye, ground, [&](std::size_t cell, const SightLine& line) {
        const double lowest = ground.elevation[cell], found = work_->found[cell];
        const double expected = least(line, lowest, work_->wanted[cell], work_->highest[cell]);
        // Where two triangles meet below the line, either may be found: they agree but for the last bit.
        EXPECT_TRUE(std::abs(found - expected) < 1e-8 || (std::isnan(found) && std::isnan(expected)))
            << found << ", not " << expected << " over " << lowest;
        EXPECT_EQ(found == lowest, expected == lowest);
        EXPECT_EQ(found <= work_->wanted[cell], expected <= work_->wanted[cell]);
        ++(std::isnan(found) ? tally.hidden : found == lowest ? tally.seen : tally.partly);
      });
    });
    return tally;
  }

 private:
  struct Work {
    TileValues<double> wanted, highest;
    RadialSweep::Heights found;
    RadialSweep::Scratch scratch;
  };

  template <class Visit>
  void for_each_line(const Point3& eye, const RadialSweep::Ends& ends, const Visit& visit) const {
    for (std::size_t k = 0; k < ends.elevation.size(); ++k) {
      const Point3 end{ends.centres.x[k % Tile::kSide], ends.centres.y[k / Tile::kSide], ends.elevation[k]};
      if (std::isnan(end.z)) continue;
      if (same_place(end.x - eye.x, end.y - eye.y)) {
        EXPECT_TRUE(std::isinf(work_->found[k]));
      } else {
        visit(k, SightLine(eye, end, drop_, kGrazing / tin_.grid.resolution));
      }
    }
  }

  template <class Test>
  bool any(const Test& test) const {
    return std::any_of(tin_.triangles.begin(), tin_.triangles.end(), [&](const Triangle& t) {
      return test(tin_.vertices[t[0]], tin_.vertices[t[1]], tin_.vertices[t[2]]);
    });
  }
  bool hides(const SightLine& line) const {
    return any([&](const auto&... corner) { return line.hidden_by(corner...); });
  }
  double least(const SightLine& to_ground, double lowest, double wanted, double highest) const {
    if (!hides(to_ground)) return lowest;
    if (hides(to_ground.with_end(highest))) return NAN;
    if (!hides(to_ground.with_end(wanted))) highest = wanted;
    double least = lowest;
    any([&](const auto&... corner) {
      least = std::max(least, to_ground.clearing_end(corner...));
      return false;
    });
    return std::min(least, highest);
  }

  const Tin& tin_;
  double drop_;
  BinnedHeights bins_;
  RadialSweep sweep_;
  RaisedGround ground_;
  std::unique_ptr<Work> work_ = std::make_unique<Work>();
};

Point3 above(const Tin& tin, Point2 position, double height) {
  const double unit = tin.grid.resolution;
  return {easting_in_units(tin.grid, position.x), northing_in_units(tin.grid, position.y),
          (height_on(tin, position).value_or(0) + height) / unit};
}

class AnEye : public testing::Test {
 protected:
  /// Sees from a height, and asks from what height on cells are seen.
  void look(LookingAround& around, const Point3& eye, double target_height) {
    const Tally t = around.see(eye, target_height), r = around.raise(eye, target_height, 150);
    all_.seen += t.seen, all_.hidden += t.hidden, all_.partly += r.partly;
    EXPECT_GE(r.seen + r.partly, t.seen);
  }
  void TearDown() override {
    EXPECT_GT(all_.seen, 100);
    EXPECT_GT(all_.hidden, 100);
    EXPECT_GT(all_.partly, 100);
  }

  std::mt19937 random_{test::seed()};
  Tally all_;
};

TEST_F(AnEye, SeesWhatTheWalkOverEveryTriangleSays) {
  const std::vector<double> z = test::fractal_heights(33, 60, 0.5, random_());
  const Tin lattice = test::lattice_tin(33, 33, 50, [&](std::int32_t c, std::int32_t r) {
    return (c / 5 + r / 5) % 5 == 0 ? NAN : z[static_cast<std::size_t>(r) * 33 + static_cast<std::size_t>(c)];
  });
  const Tin walls = test::lattice_tin(
      41, 41, 5, [](std::int32_t c, std::int32_t r) { return c % 7 < 2 && r % 11 < 4 ? 9.0 + c % 5 : 0.01 * c; });
  const Tin scattered = test::random_tin(random_, 300, 0.1, {{500000, 4000000}, 0.01}, 50000);
  for (const Tin* tin : {&lattice, &walls, &scattered}) {
    const Box box = tin->bounds();
    LookingAround closely(*tin, {}, std::max(box.width(), box.height()) / 48), around(*tin, {}, box.width() / 32);
    for (const double height : {0.0, 2.0, 30.0})
      look(closely, above(*tin, place_in(*tin, random_), height), height == 2 ? 0 : 2);
    // On a vertex, and so on corners and edges of bins; and from outside.
    const Point3 vertex = tin->point(static_cast<std::uint32_t>(random_() % tin->vertices.size()));
    for (const double height : {0.0, 3.0}) look(around, above(*tin, {vertex.x, vertex.y}, height), 1);
    look(around, above(*tin, {box.xmin - 0.3 * box.width(), box.ymax + 2 * box.height()}, 90), 1);
  }
}

TEST_F(AnEye, SeesAlongBentLines) {
  const Tin tin = test::fractal_tin(17, 4000, 60, 0.5, random_());
  for (const double k : {0.13, -0.5, 0.9, 1.4, 3.0}) {
    Earth earth;
    earth.refraction = k;
    LookingAround around(tin, earth, 1100);
    look(around, above(tin, place_in(tin, random_), 40), 2);
  }
}

TEST_F(AnEye, SeesPlainsThatEveryLineGrazes) {
  const Tin plain = test::lattice_tin(25, 25, 50, [](std::int32_t c, std::int32_t) { return c % 8 == 0 ? 1e-2 : 0.0; });
  for (const double height : {0.0, 0.01, 2.0}) {
    LookingAround around(plain, Earth::flat(), 17);
    look(around, above(plain, place_in(plain, random_), height), 0);
    look(around, above(plain, {300000 + 50 * 8, 200000 + 50 * 12}, height), 0);
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
    const auto east = bins.runs().eastwards();
    const std::int64_t run = bin.column / RunBounds::kRun;
    const auto height = exact.height(p);
    if (!height) {
      EXPECT_EQ(east.low(run, bin.row), -INFINITY);
      continue;
    }
    ++looked;
    const double z = *height / unit;
    EXPECT_LE(z, bins.upper_plane(bin).at(column - static_cast<double>(bin.column) - 0.5,
                                          row - static_cast<double>(bin.row) - 0.5) +
                     1e-6);
    EXPECT_LE(z, east.high(run, bin.row) + 1e-6);
    EXPECT_GE(z, east.low(run, bin.row) - 1e-6);
    const auto south = bins.runs().southwards();
    const std::int64_t down = bin.row / RunBounds::kRun;
    EXPECT_LE(z, south.high(down, bin.column) + 1e-6);
    EXPECT_GE(z, south.low(down, bin.column) - 1e-6);
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
