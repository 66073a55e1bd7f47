#include <cmath>
#include <gmock/gmock.h>
#include <limits>

#include <gtest/gtest.h>

#include <itin/error.hpp>
#include <itin/window.hpp>

namespace itin {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

template <typename Make>
std::string complaint(const Make& make) {
  try {
    make();
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    return error.what();
  }
  return "no complaint";
}

double distance_to_segment(Point2 p, Point2 a, Point2 b) {
  const double length2 = (b.x - a.x) * (b.x - a.x) + (b.y - a.y) * (b.y - a.y);
  const double t = std::clamp(((p.x - a.x) * (b.x - a.x) + (p.y - a.y) * (b.y - a.y)) / length2, 0.0, 1.0);
  return std::hypot(a.x + t * (b.x - a.x) - p.x, a.y + t * (b.y - a.y) - p.y);
}

TEST(Window, DiscIsCircumscribed) {
  const Point2 centre{318000, 176000};
  const Window window = Window::disc(centre, 5000);
  const auto& ring = window.parts().at(0).outer;
  ASSERT_EQ(ring.size(), static_cast<std::size_t>(Window::kArcSides));
  for (std::size_t i = 0; i < ring.size(); ++i)
    EXPECT_NEAR(distance_to_segment(centre, ring[i], ring[(i + 1) % ring.size()]), 5000, 1e-6);
}

TEST(Window, WedgeLooksAlongItsAzimuth) {
  const Window window = Window::wedge({100, 200}, 90, 60, 50);
  const Box box = window.bounds();
  EXPECT_NEAR(box.xmin, 100, 1e-9);
  EXPECT_NEAR(box.xmax, 150, 0.01);
  EXPECT_NEAR(box.ymax - 200, 25, 0.01);
  EXPECT_NEAR(200 - box.ymin, 25, 0.01);
  EXPECT_EQ(window.parts().at(0).outer.size(), 43u + 1 + 1);  // ceil(256 / 6) parts, and the apex
}

TEST(Window, WholeTurnIsTheDisc) {
  EXPECT_EQ(Window::wedge({1, 2}, 77, 360, 9).parts().at(0).outer, Window::disc({1, 2}, 9).parts().at(0).outer);
}

TEST(Window, CorridorIsARectangle) {
  const Box box = Window::corridor({0, 0}, {0, 100}, 10).bounds();
  EXPECT_EQ(box, (Box{-5, 0, 5, 100}));
}

TEST(Window, AllHasNoBounds) {
  EXPECT_TRUE(Window::all().is_all());
  EXPECT_TRUE(Window::all().bounds().empty());
}

TEST(Window, PolygonMayRepeatItsFirstCorner) {
  const Window window = Window::polygons({{{{0, 0}, {4, 0}, {4, 0}, {4, 4}, {0, 0}}, {}}});
  EXPECT_EQ(window.parts().at(0).outer.size(), 3u);
}

TEST(Window, RefusesWhatIsNotAShape) {
  using ::testing::StartsWith;
  EXPECT_THAT(complaint([] { Window::box({0, 0, kNan, 1}); }), StartsWith("box: x is not a finite number"));
  EXPECT_THAT(complaint([] { Window::box({5, 0, 4, 1}); }), StartsWith("box: 5,0,4,1 is empty"));
  EXPECT_THAT(complaint([] { Window::box({5, 0, 5, 1}); }), StartsWith("box: 5,0,5,1 is empty"));
  EXPECT_THAT(complaint([] {
                Window::box({-1e13, 0, 5, 1});
              }),
              StartsWith("box: x -10000000000000 is beyond the limit"));
  EXPECT_THAT(complaint([] { Window::disc({0, 0}, 0); }), StartsWith("disc: radius must be greater than 0"));
  EXPECT_THAT(complaint([] { Window::disc({0, 0}, kInfinity); }), StartsWith("disc: radius is not a finite number"));
  EXPECT_THAT(complaint([] { Window::wedge({0, 0}, 0, 0, 1); }), StartsWith("wedge: width"));
  EXPECT_THAT(complaint([] { Window::wedge({0, 0}, 0, 361, 1); }), StartsWith("wedge: width"));
  EXPECT_THAT(complaint([] { Window::wedge({0, 0}, kNan, 90, 1); }), StartsWith("wedge: azimuth"));
  EXPECT_THAT(complaint([] { Window::wedge({0, 0}, 0, 90, -1); }), StartsWith("wedge: radius"));
  EXPECT_THAT(complaint([] { Window::corridor({1, 1}, {1, 1}, 5); }), StartsWith("corridor: both ends are (1, 1)"));
  EXPECT_THAT(complaint([] { Window::corridor({1, 1}, {2, 1}, 0); }), StartsWith("corridor: width"));
  EXPECT_THAT(complaint([] { Window::polygons({}); }), StartsWith("polygon: there is none"));
  EXPECT_THAT(complaint([] { Window::polygons({{{}, {}}}); }), StartsWith("polygon: a ring needs"));
  EXPECT_THAT(complaint([] {
                Window::polygons({{{{0, 0}, {1, 1}, {0, 0}, {1, 1}}, {}}});
              }),
              StartsWith("polygon: a ring needs"));
  EXPECT_THAT(complaint([] {
                Window::polygons({{{{0.1, 0.1}, {0.2, 0.2}, {0.7, 0.7}}, {}}});
              }),
              StartsWith("polygon: the ring at (0.1, 0.1) has no area"));
}

TEST(Window, RefusesCrossingEdges) {
  using ::testing::HasSubstr;
  EXPECT_THAT(complaint([] { Window::polygons({{{{0, 0}, {4, 4}, {4, 0}, {0, 4}}, {}}}); }), HasSubstr("crosses"));
  EXPECT_THAT(complaint([] {
                Window::polygons({{{{0, 0}, {9, 0}, {9, 9}, {0, 9}}, {{{5, 5}, {12, 6}, {6, 7}}}}});
              }),
              HasSubstr("crosses"));
  // Rings that only touch are fine: at a corner, and a corner on an edge.
  EXPECT_NO_THROW(Window::polygons({{{{0, 0}, {4, 4}, {8, 0}, {8, 8}, {4, 4}, {0, 8}}, {}}}));
  EXPECT_NO_THROW(Window::polygons({{{{0, 0}, {9, 0}, {9, 9}, {0, 9}}, {{{5, 0}, {6, 6}, {4, 6}}}}}));
}

TEST(Window, PolygonsContainNothingOfTheirHoles) {
  const Window window = Window::polygons({{{{0, 0}, {10, 0}, {10, 10}, {0, 10}}, {{{4, 4}, {6, 4}, {6, 6}, {4, 6}}}}});
  EXPECT_TRUE(window.contains({1, 1}));
  EXPECT_FALSE(window.contains({5, 5}));
  EXPECT_FALSE(window.contains({11, 5}));
  EXPECT_TRUE(Window::all().contains({11, 5}));
}

}  // namespace
}  // namespace itin
