// Names in a row, against what holds of every such row; and on panoramas, where rows are drawn.
#include "drawing/label_row.hpp"

#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include <profile/chart.hpp>

#include "support/seed.hpp"

namespace itin::profile {

namespace {

using testing::HasSubstr;
using testing::Not;

constexpr RowSpace kSpace{.from = 0, .to = 500, .apart = 10, .most = 60};

/// No interval holds more names than there is room for: of the places within [a, b], all names lie in it widened by
/// the most that a name may stand off, and within the row.
bool hall_holds(std::vector<double> at, const RowSpace& space) {
  std::sort(at.begin(), at.end());
  for (std::size_t i = 0; i < at.size(); ++i)
    for (std::size_t j = i; j < at.size(); ++j) {
      const double left = std::max(at[i] - space.most, space.from), right = std::min(at[j] + space.most, space.to);
      if (right - left < space.apart * static_cast<double>(j - i) - 1e-9) return false;
    }
  return true;
}

TEST(LabelRow, NamesWhatHasRoomAndNothingMore) {
  std::mt19937 random(test::seed());
  for (int round = 0; round < 200; ++round) {
    std::vector<RowPlace> places;
    const double wide = round % 2 == 0 ? 500 : 100;
    for (int i = 0; i < 5 + round / 3; ++i)
      places.push_back({std::uniform_real_distribution(0.0, wide)(random), std::uniform_real_distribution()(random)});
    const std::vector<RowLabel> labels = label_row(places, kSpace);
    std::set<std::size_t> named;
    for (std::size_t k = 0; k < labels.size(); ++k) {
      EXPECT_TRUE(named.insert(labels[k].index).second);
      EXPECT_GE(labels[k].at, kSpace.from);
      EXPECT_LE(labels[k].at, kSpace.to);
      EXPECT_LE(std::abs(labels[k].at - places[labels[k].index].at), kSpace.most + 1e-9);
      if (k == 0) continue;
      EXPECT_GE(labels[k].at - labels[k - 1].at, kSpace.apart - 1e-9);
      EXPECT_LE(places[labels[k - 1].index].at, places[labels[k].index].at);
    }
    // What is left out has no room beside those that are more important.
    for (std::size_t i = 0; i < places.size(); ++i) {
      std::vector<double> before{places[i].at};
      for (const std::size_t j : named)
        if (places[j].importance > places[i].importance) before.push_back(places[j].at);
      EXPECT_EQ(named.contains(i), hall_holds(before, kSpace));
    }
  }
}

TEST(LabelRow, LeavesNamesThatHaveRoomWhereTheyAre) {
  const std::vector<RowLabel> labels = label_row({{300, 1}, {100, 2}, {310, 3}}, kSpace);
  ASSERT_EQ(labels.size(), 3U);
  EXPECT_EQ(labels[0].index, 1U);
  for (const RowLabel& label : labels) EXPECT_EQ(label.at, std::vector<double>({300, 100, 310})[label.index]);
}

Panorama with_places(int count) {
  Panorama panorama;
  for (int degrees = 0; degrees < 360; ++degrees) panorama.skyline.push_back({static_cast<double>(degrees), 2, 3000});
  for (int i = 0; i < count; ++i)
    panorama.places.push_back({"Farm " + std::to_string(i), 45, 1, 1000.0 + 10 * i, i == count - 1});
  return panorama;
}

TEST(LabelRow, APanoramaSaysHowManyNamesItLeavesOut) {
  EXPECT_THAT(draw_panorama(with_places(10), "a.svg"), Not(HasSubstr("left out")));
  // Within 60 points on either side 13 names have room, 10 points apart: what is seen, and the nearest.
  const std::string svg = draw_panorama(with_places(40), "a.svg");
  EXPECT_THAT(svg, HasSubstr(">27 of 40 names left out for want of room</text>"));
  EXPECT_THAT(svg, HasSubstr(">Farm 39, "));
  EXPECT_THAT(svg, HasSubstr(">Farm 11, "));
  EXPECT_THAT(svg, Not(HasSubstr(">Farm 12, ")));
}

TEST(LabelRow, APanoramaGrowsWithItsNames) {
  const auto width_of = [](const Panorama& panorama) {
    const std::string svg = draw_panorama(panorama, "a.svg");
    return std::stod(svg.substr(svg.find("width=\"") + 7));
  };
  Panorama panorama = with_places(0);
  const double plain = width_of(panorama);
  panorama.places.push_back({"A farm with a rather long name for the edge", 358, 1, 1000, true});
  EXPECT_GT(width_of(panorama), plain + 50);
}

}  // namespace

}  // namespace itin::profile
