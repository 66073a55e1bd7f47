// GridWindow against a twin that knows no index: every edge, in 128-bit arithmetic.
#include "triangulate/region/grid_window.hpp"

#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include <itin/int128.hpp>

#include "support/seed.hpp"

namespace itin {
namespace {

struct Corner {
  std::int64_t x, y;
};

using Ring = std::vector<Corner>;

Int128 turn(Corner a, Corner b, Corner c) {
  return Int128{b.x - a.x} * (c.y - a.y) - Int128{b.y - a.y} * (c.x - a.x);
}
int sign(Int128 v) {
  return v > 0 ? 1 : v < 0 ? -1 : 0;
}

bool on_segment(Corner a, Corner b, Corner p) {
  return turn(a, b, p) == 0 && std::min(a.x, b.x) <= p.x && p.x <= std::max(a.x, b.x) && std::min(a.y, b.y) <= p.y &&
         p.y <= std::max(a.y, b.y);
}
bool segments_meet(Corner a, Corner b, Corner c, Corner d) {
  if (on_segment(a, b, c) || on_segment(a, b, d) || on_segment(c, d, a) || on_segment(c, d, b)) return true;
  return sign(turn(a, b, c)) * sign(turn(a, b, d)) < 0 && sign(turn(c, d, a)) * sign(turn(c, d, b)) < 0;
}

/// Rings whose interiors count +1 (outer) or -1 (hole); crossing parity of each ring on its own.
struct Twin {
  std::vector<Ring> outers, holes;

  static bool inside_ring(const Ring& ring, Corner p) {
    bool inside = false;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      Corner a = ring[i], b = ring[(i + 1) % ring.size()];
      if (a.y > b.y) std::swap(a, b);
      if (a.y <= p.y && p.y < b.y && turn(a, b, p) > 0) inside = !inside;
    }
    return inside;
  }
  template <typename Visit>
  bool any_edge(const Visit& visit) const {
    for (const auto* rings : {&outers, &holes}) {
      for (const Ring& ring : *rings) {
        for (std::size_t i = 0; i < ring.size(); ++i)
          if (visit(ring[i], ring[(i + 1) % ring.size()])) return true;
      }
    }
    return false;
  }
  bool contains(Corner p) const {
    if (any_edge([&](Corner a, Corner b) { return on_segment(a, b, p); })) return true;
    int wound = 0;
    for (const Ring& r : outers) wound += inside_ring(r, p);
    for (const Ring& r : holes) wound -= inside_ring(r, p);
    return wound > 0;
  }
  /// `figure`: the corners of a convex polygon.
  bool meets(const Ring& figure) const {
    if (contains(figure[0])) return true;
    return any_edge([&](Corner a, Corner b) {
      bool within = true;
      int side = 0;
      for (std::size_t i = 0; i < figure.size(); ++i) {
        const Corner p = figure[i], q = figure[(i + 1) % figure.size()];
        if (segments_meet(a, b, p, q)) return true;
        const int s = sign(turn(p, q, a));
        within = within && s != 0 && (side == 0 || s == side);
        side = s;
      }
      return within;
    });
  }
};

const Grid kUnitGrid{{0, 0}, 1.0};

Ring quantised(const Window::Ring& ring) {
  Ring result;
  for (const Point2& p : ring) result.push_back({std::llround(p.x), std::llround(p.y)});
  return result;
}
Twin twin_of(const Window& window) {
  Twin twin;
  for (const auto& part : window.parts()) {
    twin.outers.push_back(quantised(part.outer));
    for (const auto& hole : part.holes) twin.holes.push_back(quantised(hole));
  }
  return twin;
}

class GridWindowTest : public ::testing::Test {
 protected:
  double number(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  std::int32_t integer(std::int32_t low, std::int32_t high) {
    return std::uniform_int_distribution<std::int32_t>(low, high)(random_);
  }
  /// A star-shaped ring, never crossing itself.
  Window::Ring star(Point2 centre, double low, double high, int corners) {
    Window::Ring ring;
    for (int i = 0; i < corners; ++i) {
      const double angle = 2 * M_PI * i / corners, radius = number(low, high);
      ring.push_back(
          {std::round(centre.x + radius * std::cos(angle)), std::round(centre.y + radius * std::sin(angle))});
    }
    return ring;
  }
  /// Compares at random positions, boxes and triangles about [-reach, reach]^2, some of them touching corners.
  void compare(const Window& window, std::int32_t reach, int rounds) {
    const GridWindow fast(window, kUnitGrid, {});
    const Twin slow = twin_of(window);
    const auto corner = [&]() -> GridPoint {
      const auto& ring = slow.outers[static_cast<std::size_t>(integer(0, static_cast<int>(slow.outers.size()) - 1))];
      const Corner p = ring[static_cast<std::size_t>(integer(0, static_cast<int>(ring.size()) - 1))];
      return {static_cast<std::int32_t>(p.x), static_cast<std::int32_t>(p.y), 0};
    };
    int hits = 0;
    for (int round = 0; round < rounds; ++round) {
      const std::int32_t size = std::max(1, reach >> integer(0, 8));
      const GridPoint o = integer(0, 3) == 0 ? corner() : GridPoint{integer(-reach, reach), integer(-reach, reach), 0};
      const auto near = [&] { return GridPoint{o.x + integer(-size, size), o.y + integer(-size, size), 0}; };
      GridPoint a = integer(0, 1) == 0 ? o : near();
      const GridPoint b = near(), c = near();
      ASSERT_EQ(fast.contains(a.x, a.y), slow.contains({a.x, a.y})) << a.x << ' ' << a.y;
      if (turn({a.x, a.y}, {b.x, b.y}, {c.x, c.y}) != 0) {
        const bool expected = slow.meets({{a.x, a.y}, {b.x, b.y}, {c.x, c.y}});
        hits += expected;
        ASSERT_EQ(fast.meets(a, b, c), expected)
            << a.x << ' ' << a.y << ' ' << b.x << ' ' << b.y << ' ' << c.x << ' ' << c.y;
        ASSERT_EQ(fast.meets(c, b, a), expected);
      }
      GridBox box;
      box.extend(a.x, a.y), box.extend(b.x, b.y);
      ASSERT_EQ(fast.meets(box),
                slow.meets({{box.xmin, box.ymin}, {box.xmax, box.ymin}, {box.xmax, box.ymax}, {box.xmin, box.ymax}}))
          << box.xmin << ' ' << box.ymin << ' ' << box.xmax << ' ' << box.ymax;
      for (int i = 0; i < 8 && fast.holds(box); ++i) {
        const int x = integer(box.xmin, box.xmax), y = integer(box.ymin, box.ymax);
        ASSERT_TRUE(slow.contains({x, y})) << x << ' ' << y;
      }
    }
    EXPECT_GT(hits, 0) << "the figures never met the window";
    EXPECT_LT(hits, rounds) << "the figures always met the window";
  }

  std::mt19937 random_{test::seed()};
};

TEST_F(GridWindowTest, BoxAgreesWithTwin) {
  for (const std::int32_t reach : {6, 50, 100000})
    compare(Window::box({-0.4 * reach, -0.3 * reach, 0.5 * reach, 0.6 * reach}), reach, 20000);
}

TEST_F(GridWindowTest, DiscAgreesWithTwin) {
  for (const std::int32_t reach : {20, 300, 1000000}) compare(Window::disc({3, -5}, 0.6 * reach), reach, 4000);
}

TEST_F(GridWindowTest, WedgeAgreesWithTwin) {
  for (const double width : {1.0, 60.0, 180.0, 270.0, 359.0})
    compare(Window::wedge({0, 0}, number(-720, 720), width, 700), 1000, 2000);
}

TEST_F(GridWindowTest, CorridorAgreesWithTwin) {
  for (int i = 0; i < 20; ++i)
    compare(Window::corridor({number(-90, 0), number(-90, 90)}, {number(1, 90), number(-90, 90)}, number(1, 30)), 100,
            2000);
}

TEST_F(GridWindowTest, PolygonWithHolesAgreesWithTwin) {
  for (int i = 0; i < 30; ++i) {
    const double reach = std::pow(10, number(1.5, 7));
    const int most = std::clamp(static_cast<int>(reach / 8), 3, 400);  // rounded corners must not cross
    std::vector<Window::Polygon> parts(2);
    parts[0].outer = star({-reach / 2, 0}, 0.3 * reach, 0.5 * reach, integer(3, std::min(most, 60)));
    parts[0].holes = {star({-reach / 2, 0}, 0.05 * reach, 0.13 * reach, 3)};
    parts[1].outer = star({reach / 2, 0}, 0.1 * reach, 0.45 * reach, integer(3, most));
    if (integer(0, 1) != 0) std::reverse(parts[1].outer.begin(), parts[1].outer.end());
    compare(Window::polygons(parts), static_cast<std::int32_t>(reach), 2000);
  }
}

TEST_F(GridWindowTest, OverlappingPartsAreTheirUnion) {
  for (int i = 0; i < 10; ++i) {
    std::vector<Window::Polygon> parts(3);
    for (auto& part : parts) part.outer = star({number(-30, 30), number(-30, 30)}, 20, 60, integer(3, 12));
    compare(Window::polygons(parts), 100, 3000);
  }
}

TEST_F(GridWindowTest, BoxesSideBySideAreTheirUnion) {
  for (int i = 0; i < 30; ++i) {
    std::vector<Window::Polygon> parts;
    for (int k = integer(2, 25); k > 0; --k) {
      const double x = 20 * integer(-5, 4), y = 20 * integer(-5, 4), w = 20 * integer(1, 2), h = 20 * integer(1, 3);
      parts.push_back({{{x, y}, {x + w, y}, {x + w, y + h}, {x, y + h}}, {}});
    }
    compare(Window::polygons(parts), 120, 1000);
  }
  const GridWindow pair(
      Window::polygons({{{{0, 0}, {5, 0}, {5, 9}, {0, 9}}, {}}, {{{5, 0}, {9, 0}, {9, 9}, {5, 9}}, {}}}), kUnitGrid,
      {});
  EXPECT_TRUE(pair.contains(5, 4));
  EXPECT_TRUE(pair.meets({4, 4, 0}, {6, 4, 0}, {5, 6, 0}));
}

TEST_F(GridWindowTest, HolesOutsideTheirPartAreNothingButTheirBoundary) {
  for (int i = 0; i < 5; ++i) {
    compare(Window::polygons({{star({-40, 0}, 20, 40, 9), {star({40, 0}, 20, 40, 9)}}}), 100, 3000);
  }
}

TEST_F(GridWindowTest, HoldsWhatLiesWellInside) {
  const GridWindow disc(Window::disc({0, 0}, 10000), kUnitGrid, {}), box(Window::box({0, 0, 10, 10}), kUnitGrid, {});
  EXPECT_TRUE(disc.holds({-2000, -2000, 2000, 2000}));
  EXPECT_FALSE(disc.holds({-2000, -2000, 2000, 9999}));
  EXPECT_FALSE(disc.holds({9000, 9000, 9100, 9100}));
  EXPECT_TRUE(box.holds({0, 0, 10, 10}));
  EXPECT_FALSE(box.holds({0, 0, 11, 10}));
}

TEST_F(GridWindowTest, ShapesThinnerThanTheGridKeepTheirBoundary) {
  const GridWindow segment(Window::corridor({0, 0}, {10, 10}, 0.01), kUnitGrid, {});
  EXPECT_TRUE(segment.contains(4, 4));
  EXPECT_FALSE(segment.contains(4, 5));
  EXPECT_TRUE(segment.meets({4, 4, 0}, {8, 0, 0}, {9, 1, 0}));
  EXPECT_FALSE(segment.meets({5, 4, 0}, {8, 0, 0}, {9, 1, 0}));
  EXPECT_TRUE(segment.meets({5, 5, 5, 9}));
  const GridWindow point(Window::disc({7.1, 3.2}, 0.01), kUnitGrid, {});
  EXPECT_TRUE(point.contains(7, 3));
  EXPECT_FALSE(point.contains(7, 4));
  EXPECT_TRUE(point.meets({6, 3, 0}, {8, 3, 0}, {7, 9, 0}));
  EXPECT_FALSE(point.meets({6, 4, 0}, {8, 4, 0}, {7, 9, 0}));
  EXPECT_TRUE(point.meets({7, 0, 7, 9}));
}

TEST_F(GridWindowTest, TwoSidesOfABoxAreNotTheBox) {
  const GridWindow sides(
      Window::polygons({{{{0, 0}, {9, 0}, {9, 0.1}, {0, 0.1}}, {}}, {{{9, 9}, {0, 9}, {0, 9.1}, {9, 9.1}}, {}}}),
      kUnitGrid, {});
  EXPECT_TRUE(sides.contains(5, 0));
  EXPECT_TRUE(sides.contains(5, 9));
  EXPECT_FALSE(sides.contains(5, 5));
}

TEST_F(GridWindowTest, AllIsTheDataBounds) {
  const GridBox data{-5, -6, 7, 8};
  const GridWindow window(Window::all(), kUnitGrid, data);
  EXPECT_EQ(window.bounds(), data);
  EXPECT_TRUE(window.contains(7, 8));
  EXPECT_FALSE(window.contains(8, 8));
  EXPECT_TRUE(window.meets({7, 8, 0}, {20, 8, 0}, {20, 9, 0}));
  EXPECT_FALSE(window.meets({14, 0, 0}, {0, 19, 0}, {20, 20, 0}));
}

TEST_F(GridWindowTest, HugeWindowsHoldTheWholeGrid) {
  constexpr std::int32_t low = -kGridHalfSide, high = kGridHalfSide - 1;
  const double far = Window::kLimit;
  for (const Window& window :
       {Window::disc({5, 5}, far), Window::box({-far, -far, far, far}), Window::wedge({-far / 2, 0}, 90, 179, far),
        Window::polygons({{{{-far, -far}, {far, -far}, {0, far}}, {}}})}) {
    const GridWindow fast(window, kUnitGrid, {});
    EXPECT_EQ(fast.bounds(), (GridBox{low, low, high, high}));
    for (int i = 0; i < 1000; ++i) {
      EXPECT_TRUE(fast.contains(integer(low, high), integer(low, high)));
      const GridPoint p{integer(low, high - 1), integer(low, high - 1), 0};
      EXPECT_TRUE(fast.meets(p, {p.x + 1, p.y, 0}, {p.x, p.y + 1, 0}));
    }
    EXPECT_TRUE(fast.contains(low, low));
    EXPECT_TRUE(fast.contains(high, high));
  }
}

TEST_F(GridWindowTest, EdgesCutAtTheGridStayWithinOneStep) {
  // A half plane below the line y = x / 3 + 7, its other corners far away.
  const double far = 3e9;
  const GridWindow fast(
      Window::polygons({{{{-far, -far / 3 + 7}, {-far, -2 * far}, {far, -2 * far}, {far, far / 3 + 7}}, {}}}),
      kUnitGrid, {});
  for (int i = 0; i < 10000; ++i) {
    const std::int32_t x = integer(-kGridHalfSide, kGridHalfSide - 1);
    const auto y = static_cast<std::int32_t>(std::floor(x / 3.0 + 7));
    EXPECT_TRUE(fast.contains(x, y - 1));
    EXPECT_FALSE(fast.contains(x, y + 2));
  }
}

TEST_F(GridWindowTest, WindowOutsideTheGridMeetsNothing) {
  const GridWindow fast(Window::disc({1e10, 0}, 1000), kUnitGrid, {});
  EXPECT_TRUE(fast.bounds().empty());
  EXPECT_FALSE(fast.contains(kGridHalfSide - 1, 0));
  EXPECT_FALSE(fast.meets(GridBox{-kGridHalfSide, -kGridHalfSide, kGridHalfSide - 1, kGridHalfSide - 1}));
  EXPECT_FALSE(fast.meets({-kGridHalfSide, -kGridHalfSide, 0}, {kGridHalfSide - 1, 0, 0}, {0, kGridHalfSide - 1, 0}));
  const GridWindow ring(Window::polygons({{{{-1e10, -1e10}, {1e10, -1e10}, {1e10, 1e10}, {-1e10, 1e10}},
                                           {{{-1e9, -1e9}, {1e9, -1e9}, {1e9, 1e9}, {-1e9, 1e9}}}}}),
                        kUnitGrid, {});
  EXPECT_FALSE(ring.contains(0, 0));
  EXPECT_FALSE(ring.contains(kGridHalfSide - 1, kGridHalfSide - 1));
  EXPECT_FALSE(ring.meets(GridBox{-kGridHalfSide, -kGridHalfSide, kGridHalfSide - 1, kGridHalfSide - 1}));
}

TEST_F(GridWindowTest, ReachesTheCornersOfTheGrid) {
  constexpr std::int32_t low = -kGridHalfSide, high = kGridHalfSide - 1;
  const GridWindow fast(Window::polygons({{{{low, low}, {high, low}, {low, high}}, {}}}), kUnitGrid, {});
  EXPECT_TRUE(fast.contains(0, -1));
  EXPECT_FALSE(fast.contains(0, 0));
  EXPECT_FALSE(fast.meets({0, 0, 0}, {high, 0, 0}, {0, high, 0}));
  EXPECT_TRUE(fast.meets({0, -1, 0}, {high, high, 0}, {0, high, 0}));
}

}  // namespace
}  // namespace itin
