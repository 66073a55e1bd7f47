// The least share of the first Fresnel zone that is clear: pieces of ground that are left out change nothing.
#include <cmath>
#include <optional>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include <itin/fresnel_zone.hpp>

#include "support/seed.hpp"

namespace itin {

namespace {

/// Few places, so that the bulge is as high as the ground is, and the least fraction is within a piece.
std::vector<GroundPoint> random_ground(std::mt19937& random) {
  std::uniform_real_distribution<double> apart(0.01, 1), height(0, 10);
  std::vector<GroundPoint> ground = {{0, height(random)}};
  while (ground.size() < 6) ground.push_back({ground.back().distance + apart(random), height(random)});
  const double length = ground.back().distance;
  for (GroundPoint& p : ground) p.distance = &p == &ground.back() ? 1 : p.distance / length;
  return ground;
}

/// Rounding may put a target a hair above or below what it stands level with: its zone is cut there, either way.
TEST(LeastFraction, IsNoneWhereAnEndTouchesTheGround) {
  for (const double clearance : {-1e-7, -1e-15, 0.0, 1e-15, 1e-7}) {
    for (const double end : {0.0, 1.0}) {
      LeastFraction least(0.2, 1e-6);
      const double middle = 0.5, far = 5;
      least.consider(end, clearance);
      least.consider(middle, far);
      ASSERT_TRUE(least.least());
      EXPECT_EQ(least.least()->fraction, 0) << clearance << " at " << end;
    }
  }
  LeastFraction clear(0.2, 1e-6);
  clear.consider(0, 2e-6);
  EXPECT_FALSE(clear.least());
}

TEST(LeastFraction, IsThatOfEveryPieceByItself) {
  std::mt19937 random(test::seed());
  std::uniform_real_distribution<double> end(-20, 60), drop(0, 100);
  for (int round = 0; round < 20'000; ++round) {
    const std::vector<GroundPoint> ground = random_ground(random);
    const LineOverGround line(end(random), end(random), 1, drop(random));
    constexpr double kUnit = 30;
    LeastFraction least(kUnit, 0);
    std::optional<LeastFraction::Place> slow;
    const auto take = [&](const LeastFraction& one) {
      if (one.least() && (!slow || one.least()->fraction < slow->fraction)) slow = one.least();
    };
    for (const GroundPoint& p : ground) {
      LeastFraction alone(kUnit, 0);
      alone.consider(p.distance, line.clearance(p));
      take(alone);
      least.consider(p.distance, line.clearance(p));
    }
    for (std::size_t i = 0; i + 1 < ground.size(); ++i) {
      const ClearancePiece piece = line.piece(ground[i], ground[i + 1]);
      LeastFraction alone(kUnit, 0);
      alone.consider_inside(piece);
      take(alone);
      least.consider_inside(piece);
    }
    ASSERT_TRUE(least.least() && slow) << round;
    EXPECT_EQ(least.least()->fraction, slow->fraction) << round;
    EXPECT_EQ(least.least()->t, slow->t) << round;
    EXPECT_EQ(least.least()->clearance, slow->clearance) << round;
  }
}

}  // namespace

}  // namespace itin
