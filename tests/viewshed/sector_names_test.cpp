#include <gtest/gtest.h>

#include <viewshed/result_sheet.hpp>
#include <viewshed/sector_names.hpp>

namespace itin::viewshed {

namespace {

TEST(SectorNames, HaveTheirMastsNameInCommon) {
  EXPECT_EQ(shared_beginning({"Cwm A", "Cwm B"}), "Cwm");
  EXPECT_EQ(shared_beginning({"Cwm - north", "Cwm - south"}), "Cwm");
  EXPECT_EQ(shared_beginning({"Cwm(1)", "Cwm(2)"}), "Cwm");
  EXPECT_EQ(shared_beginning({"Pen y Fan 1", "Pen y Fan 10"}), "Pen y Fan");
}

TEST(SectorNames, EndWhereANameEnds) {
  EXPECT_EQ(shared_beginning({"Cwm B", "Cwm"}), "Cwm");
  EXPECT_EQ(shared_beginning({"Cwm", "Cwm B"}), "Cwm");
  EXPECT_EQ(shared_beginning({"Cwm A", "Cwm A"}), "Cwm A");
}

TEST(SectorNames, HaveNoPartsOfWordsInCommon) {
  EXPECT_EQ(shared_beginning({"Cwm", "Cwmbran"}), "");
  EXPECT_EQ(shared_beginning({"north", "east"}), "");
  EXPECT_EQ(shared_beginning({"M1", "M2"}), "");
  EXPECT_EQ(shared_beginning({" A", " B"}), "");
  EXPECT_EQ(shared_beginning({"", ""}), "");
}

TEST(SectorNames, StandTogetherOnce) {
  EXPECT_EQ(names_together({"Cwm A", "Cwm B", "Cwm C"}), "Cwm A, B, C");
  EXPECT_EQ(names_together({"Cwm_1", "Cwm_2"}), "Cwm 1, 2");
  EXPECT_EQ(names_together({"Cwm (north)", "Cwm (south)"}), "Cwm (north), (south)");
  EXPECT_EQ(names_together({"north", "east", "west"}), "north, east, west");
  EXPECT_EQ(names_together({"Cwm", "Cwm B"}), "Cwm, Cwm B");
  EXPECT_EQ(names_together({"Cwm", "Cwm", "Cwm"}), "Cwm");
  EXPECT_EQ(names_together({"7"}), "7");
}

TEST(SectorNames, AreOneLabelOnMaps) {
  const MapObjects objects =
      mast_objects({{{100, 200}, "Cwm A"}, {{300, 200}, "Bryn"}, {{100, 200}, "Cwm B"}, {{500, 0}, ""}}, "Mast");
  const auto& marks = std::get<profile::SheetMarks>(objects.layers.front()).marks;
  ASSERT_EQ(marks.size(), 3U);
  EXPECT_EQ(marks[0].label, "Cwm A, B");
  EXPECT_EQ(marks[1].label, "Bryn");
  EXPECT_EQ(marks[2].label, "");
  EXPECT_EQ(marks[0].at.x, 100);
  EXPECT_EQ(marks[1].at.x, 300);
}

TEST(SectorNames, CountObserversAndTheirPlaces) {
  const Observer a{"Cwm A", {100, 200}}, b{"Cwm B", {100, 200}}, other{"Bryn", {300, 200}};
  EXPECT_EQ(counted_observers({a}), "1 observer");
  EXPECT_EQ(counted_observers({a, other}), "2 observers");
  EXPECT_EQ(counted_observers({a, b, other}), "3 observers at 2 places");
}

TEST(SectorNames, AreNoneForASingleNumberedObserver) {
  const auto label = [](const std::vector<Observer>& observers) {
    return std::get<profile::SheetMarks>(observer_objects(observers).layers.front()).marks.front().label;
  };
  EXPECT_EQ(label({{"1", {100, 200}}}), "");
  EXPECT_EQ(label({{"Garth", {100, 200}}}), "Garth");
  EXPECT_EQ(label({{"1", {100, 200}}, {"2", {300, 200}}}), "1");
}

}  // namespace

}  // namespace itin::viewshed
