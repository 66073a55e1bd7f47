// Clearances in closed form, against the same line looked at in a thousand places.
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include <itin/clearance.hpp>

#include "support/seed.hpp"
#include "support/sight_lines.hpp"

namespace itin {
namespace {

class Clearance : public testing::Test {
 protected:
  double draw(double from, double to) { return std::uniform_real_distribution<double>(from, to)(random_); }

  /// A line, and straight ground under a part of it.
  struct Case {
    double start_z, end_z, length, drop;
    GroundPoint a, b;

    LineOverGround line() const { return {start_z, end_z, length, drop}; }
    /// By definition: the chord, less the ground, less the Earth's bulge.
    double clearance(double d) const {
      const double s = (d - a.distance) / (b.distance - a.distance);
      return start_z + (end_z - start_z) * d / length - (a.z + s * (b.z - a.z)) - drop * d * (length - d);
    }
  };
  Case draw_case() {
    Case c{draw(-200, 900), draw(-200, 900), draw(10, 60000), draw(0, 1e-7), {}, {}};
    c.a = {draw(0, 0.9) * c.length, draw(-100, 1000)};
    c.b = {draw(c.a.distance + 0.01 * c.length, c.length), draw(-100, 1000)};
    return c;
  }

  std::mt19937 random_{test::seed()};
};

TEST_F(Clearance, IsTheChordLessGroundAndBulge) {
  for (int i = 0; i < 1000; ++i) {
    const Case c = draw_case();
    EXPECT_NEAR(c.line().clearance(c.a), c.clearance(c.a.distance), 1e-9);
    const ClearancePiece piece = c.line().piece(c.a, c.b);
    for (const double share : {0.0, 0.3, 1.0}) {
      const double d = c.a.distance + share * (c.b.distance - c.a.distance);
      EXPECT_NEAR(piece.at(d), c.clearance(d), 1e-7);
    }
  }
}

TEST_F(Clearance, IsTheSameFromEitherEnd) {
  for (int i = 0; i < 1000; ++i) {
    const Case c = draw_case();
    const LineOverGround back(c.end_z, c.start_z, c.length, c.drop);
    const double half = c.length / 2, level = draw(0, 500);
    EXPECT_EQ(c.line().height(half), back.height(half));
    EXPECT_EQ(LineOverGround(level, level, c.length, c.drop).height(c.a.distance), level);
  }
}

TEST_F(Clearance, IsLeastWhereItIsSaidToBe) {
  int between = 0;
  for (int i = 0; i < 1000; ++i) {
    const Case c = draw_case();
    test::LeastClearance least;
    least.consider(c.line(), c.a, c.b);
    ASSERT_TRUE(least.clearance);
    for (int k = 0; k <= 1000; ++k)
      EXPECT_GE(c.clearance(c.a.distance + (c.b.distance - c.a.distance) * k / 1000), *least.clearance - 1e-9);
    EXPECT_NEAR(c.clearance(least.place.distance), *least.clearance, 1e-9);
    const ClearancePiece piece = c.line().piece(c.a, c.b);
    EXPECT_NEAR(piece.at(piece.least_within(piece.from, piece.to)), *least.clearance, 1e-6);
    between += least.place.distance > c.a.distance && least.place.distance < c.b.distance ? 1 : 0;
  }
  EXPECT_GT(between, 0);
}

}  // namespace
}  // namespace itin
