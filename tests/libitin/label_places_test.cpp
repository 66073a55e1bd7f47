#include <random>

#include <gtest/gtest.h>

#include <itin/label_places.hpp>

#include "support/seed.hpp"

namespace itin {

namespace {

constexpr Box kFrame{0, 0, 300, 200};

/// With a name 40 wide.
MarkLabel label_at(Point2 mark) {
  return {mark, 6, 40, 8, 1};
}

bool is_at(const std::optional<Point2>& found, Point2 expected) {
  return found && found->x == expected.x && found->y == expected.y;
}

TEST(LabelPlaces, NamesGoToTheRightFirst) {
  LabelPlaces places;
  EXPECT_TRUE(is_at(places.take_beside(label_at({100, 100}), kFrame), {106, 104}));
  // To the left where the frame ends, or another name stands.
  EXPECT_TRUE(is_at(places.take_beside(label_at({280, 50}), kFrame), {234, 54}));
  EXPECT_TRUE(is_at(places.take_beside(label_at({99, 101}), kFrame), {53, 105}));
}

TEST(LabelPlaces, NoNameCoversAnotherNorAMarkNorLeavesTheFrame) {
  std::mt19937 random(test::seed());
  LabelPlaces places;
  std::vector<Box> taken;
  std::vector<Point2> marks;
  for (int i = 0; i < 60; ++i) {
    const Point2 p{std::uniform_real_distribution(0.0, 300.0)(random),
                   std::uniform_real_distribution(0.0, 200.0)(random)};
    marks.push_back(p);
    places.take(taken.emplace_back(square_about(p, 4)));
  }
  std::size_t named = 0;
  for (const Point2& mark : marks) {
    const auto at = places.take_beside(label_at(mark), kFrame);
    if (!at) continue;
    ++named;
    const Box box{at->x, at->y - 8, at->x + 40, at->y};
    EXPECT_TRUE(kFrame.contains(Point2{box.xmin, box.ymin}) && kFrame.contains(Point2{box.xmax, box.ymax}));
    for (const Box& other : taken)
      EXPECT_FALSE(box.xmin < other.xmax && other.xmin < box.xmax && box.ymin < other.ymax && other.ymin < box.ymax);
    taken.push_back(box);
  }
  EXPECT_GT(named, 5U);
  EXPECT_LT(named, marks.size());
}

}  // namespace

}  // namespace itin
