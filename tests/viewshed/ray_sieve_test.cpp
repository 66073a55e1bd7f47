// The sieve never errs about what a triangle hides, and leaves little to double precision, whatever the instructions.
#include "scene/rays/ray_sieve.hpp"

#include <array>
#include <bit>
#include <random>

#include <gtest/gtest.h>

#include "line/sight_line.hpp"
#include "support/seed.hpp"

namespace itin::viewshed {
namespace {

constexpr double kHalfWidth = 100000, kTop = 20000, kGrazingUnits = 0.01;
constexpr float kRoundings = 64 * 0x1p-24F;

class RaySieves : public testing::Test {
 protected:
  std::int32_t step(double most) {
    return std::uniform_int_distribution(-static_cast<std::int32_t>(most), static_cast<std::int32_t>(most))(random_);
  }

  /// A triangle of any size, or a wall a step thick; counterclockwise, as those of a Tin.
  std::array<GridPoint, 3> triangle(int round) {
    const double size = std::array{20.0, 1000.0, kHalfWidth / 2}[static_cast<std::size_t>(round % 3)];
    const auto height = [&] { return step(kTop / 2); };
    while (true) {
      const GridPoint a{step(kHalfWidth / 2), step(kHalfWidth / 2), height()};
      const GridPoint b{a.x + step(size), a.y + step(size), height()};
      const GridPoint c{round % 4 == 0 ? a.x + 1 : a.x + step(size), round % 4 == 0 ? a.y : a.y + step(size), height()};
      const double area = (1.0 * b.x - a.x) * (1.0 * c.y - a.y) - (1.0 * c.x - a.x) * (1.0 * b.y - a.y);
      if (area > 0) return {a, b, c};
      if (area < 0) return {a, c, b};
    }
  }

  /// Rays from about a triangle, or from afar, to it or beside it; some end on it.
  RTCRay16 rays_at(const std::array<GridPoint, 3>& corners) {
    RTCRay16 rays{};
    for (std::size_t i = 0; i < 16; ++i) {
      const double reach = i % 2 == 0 ? 30 : kHalfWidth / 2;
      const GridPoint& at = corners[random_() % 3];
      const auto off = [&](double most) { return i % 3 == 0 ? 0.0F : static_cast<float>(step(most)) / 7; };
      rays.org_x[i] = static_cast<float>(at.x + step(reach)), rays.org_y[i] = static_cast<float>(at.y + step(reach));
      rays.org_z[i] = static_cast<float>(at.z + step(kTop / 4));
      rays.dir_x[i] = static_cast<float>(at.x) + off(200) - rays.org_x[i];
      rays.dir_y[i] = static_cast<float>(at.y) + off(200) - rays.org_y[i];
      rays.dir_z[i] = static_cast<float>(at.z) + off(2000) - rays.org_z[i];
      if (rays.dir_x[i] == 0 && rays.dir_y[i] == 0) rays.dir_x[i] = 1;
      const float further = static_cast<float>(1 + static_cast<int>(i) % 3);
      rays.dir_x[i] *= further, rays.dir_y[i] *= further, rays.dir_z[i] *= further;
    }
    return rays;
  }

  static bool hides(const std::array<GridPoint, 3>& corners, const RTCRay16& rays, unsigned i) {
    const Point3 from{rays.org_x[i], rays.org_y[i], rays.org_z[i]};
    const Point3 to{from.x + rays.dir_x[i], from.y + rays.dir_y[i], from.z + rays.dir_z[i]};
    return SightLine(from, to, 0, kGrazingUnits).hidden_by(corners[0], corners[1], corners[2]);
  }

  std::mt19937 random_{test::seed()};
};

TEST_F(RaySieves, NeverErrAndLeaveLittle) {
  SieveBounds bounds;
  bounds.place = kRoundings * static_cast<float>(kHalfWidth), bounds.height = kRoundings * static_cast<float>(kTop);
  bounds.rounding = kRoundings, bounds.grazing = static_cast<float>(kGrazingUnits);
  bounds.floor = static_cast<float>(-2 * kTop), bounds.finds_hidden = true;
  for (const Instructions instructions : instructions_here()) {
    SCOPED_TRACE(static_cast<int>(instructions));
    const RaySieve sieve = ray_sieve(instructions);
    std::array<int, 16> valid{};
    valid.fill(-1);
    int hidden = 0, clear = 0, left = 0;
    for (int round = 0; round < 4000; ++round) {
      SCOPED_TRACE(round);
      const std::array<GridPoint, 3> corners = triangle(round);
      SieveCorners at{};
      for (std::size_t k = 0; k < 3; ++k)
        at.x[k] = static_cast<float>(corners[k].x), at.y[k] = static_cast<float>(corners[k].y),
        at.z[k] = static_cast<float>(corners[k].z);
      RTCRay16 rays = rays_at(corners);
      valid[static_cast<std::size_t>(round % 16)] = 0;
      RTCOccludedFunctionNArguments arguments{};
      arguments.valid = valid.data(), arguments.ray = reinterpret_cast<RTCRayN*>(&rays), arguments.N = 16;
      const SiftedRays sifted = sieve(arguments, at, bounds);
      EXPECT_EQ(sifted.hidden & ~sifted.near, 0U);
      EXPECT_EQ(sifted.near >> round % 16 & 1U, 0U) << "a ray that is not valid";
      valid[static_cast<std::size_t>(round % 16)] = -1;
      for (unsigned i = 0; i < 16; ++i) {
        if (i == static_cast<unsigned>(round % 16)) continue;
        const bool near = (sifted.near >> i & 1U) != 0, surely = (sifted.hidden >> i & 1U) != 0;
        ASSERT_TRUE(!surely || hides(corners, rays, i)) << "ray " << i;
        ASSERT_TRUE(near || !hides(corners, rays, i)) << "ray " << i;
        // Rays through a corner, every third, are meant to be left.
        if (i % 3 == 0) continue;
        hidden += surely ? 1 : 0, clear += near ? 0 : 1, left += near && !surely ? 1 : 0;
      }
    }
    EXPECT_GT(hidden, 3000);
    EXPECT_GT(clear, 10000);
    EXPECT_LT(left, (hidden + clear) / 2);
  }
}

}  // namespace
}  // namespace itin::viewshed
