#include "triangulate/apex/sight_fan.hpp"

#include <algorithm>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "support/seed.hpp"
#include "triangulate/apex/apex.hpp"

namespace itin {
namespace {

TEST(SightFan, AgreesWithLookingAtEverySegment) {
  std::mt19937 random(test::seed());
  // From far apart, where doubles round, to a lattice of few positions, where everything is collinear.
  for (const int half : {3, 12, 5000, 1 << 28}) {
    const auto position = [&] {
      const auto in = [&] { return static_cast<std::int32_t>(random() % static_cast<unsigned>(2 * half)) - half; };
      return Position{in(), in()};
    };
    int blocked = 0;
    for (int i = 0; i < 300; ++i) {
      const Position a = position(), b = position();
      if (a == b) continue;
      std::vector<Segment> segments;
      for (int k = 0; k < 1 + i % 40 * 8; ++k) {
        const Position p = position(), q = i % 2 == 0 ? position() : Position{p.x + 1, p.y - half / 4};
        if (p != q) segments.push_back({p.x, p.y, q.x, q.y, 1});
      }
      for (const Position eye : {a, b}) {
        const SightFan fan(a, b, eye, segments);
        for (int k = 0; k < 40; ++k) {
          const Position c = position();
          if (orientation(a, b, c) <= 0) continue;
          const bool expected =
              std::any_of(segments.begin(), segments.end(), [&](const Segment& s) { return crosses(s, eye, c); });
          ASSERT_EQ(fan.blocked(c), expected);
          blocked += expected;
        }
      }
    }
    EXPECT_GT(blocked, 100);
  }
}

}  // namespace
}  // namespace itin
