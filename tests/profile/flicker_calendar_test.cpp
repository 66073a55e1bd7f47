// The calendar of shadow flicker, by the colours of its pixels.
#include <algorithm>
#include <array>

#include <gtest/gtest.h>

#include <itin/error.hpp>
#include <profile/dwelling_sheet.hpp>

#include "drawing/calendar_chart.hpp"

namespace itin::profile {
namespace {

constexpr std::uint32_t kMinutesOfDay = 24 * 60;
constexpr Rgba kOneTurbine{0, 0, 200, 255}, kOtherTurbine{0, 140, 0, 255}, kByNight{208, 213, 224, 255},
    kBothTurbines{40, 40, 40, 255};

/// Flicker of a turbine from one minute of the day to another, on so many days.
CalendarTurbine flickering(const Rgba& colour, std::uint32_t from, std::uint32_t to, std::uint32_t days) {
  CalendarTurbine turbine{"turbine", colour, {}};
  for (std::uint32_t day = 0; day < days; ++day) turbine.flicker.push_back({day * kMinutesOfDay + from, to - from});
  return turbine;
}

/// Counts the pixels of just this colour above the legend.
double pixels_of(const FlickerCalendar& calendar, const Rgba& colour) {
  constexpr int kWidth = 800, kHeight = 400, kLegend = 384;
  Drawing drawing(Drawing::Format::kPixels, kWidth, kHeight, 1);
  draw_calendar(drawing, {0, 0, kWidth, kHeight}, calendar, 1);
  const std::string rgb = drawing.finish();
  double count = 0;
  for (std::size_t i = 0; i < std::size_t{3} * kWidth * kLegend; i += 3) {
    const auto channel = [&](std::size_t c) { return static_cast<unsigned char>(rgb[i + c]); };
    count += channel(0) == colour.red && channel(1) == colour.green && channel(2) == colour.blue;
  }
  return count;
}

TEST(FlickerCalendar, HasAsMuchColourAsMinutes) {
  FlickerCalendar calendar;
  calendar.turbines = {flickering(kOneTurbine, 600, 720, 100)};
  // From ten to noon, which are all hours shown, on 100 days of 365; the others are night.
  EXPECT_NEAR(pixels_of(calendar, kOneTurbine) / pixels_of(calendar, kByNight), 100.0 / 265, 0.02);
  calendar.turbines = {flickering(kOneTurbine, 600, 660, 100), flickering(kOtherTurbine, 660, 720, 50)};
  EXPECT_NEAR(pixels_of(calendar, kOtherTurbine) / pixels_of(calendar, kOneTurbine), 0.5, 0.03);
  EXPECT_EQ(pixels_of(calendar, kBothTurbines), 0);
}

TEST(FlickerCalendar, TellsMinutesOfSeveralTurbinesApart) {
  FlickerCalendar calendar;
  calendar.turbines = {flickering(kOneTurbine, 600, 680, 100), flickering(kOtherTurbine, 640, 720, 100)};
  EXPECT_NEAR(pixels_of(calendar, kOneTurbine) / pixels_of(calendar, kBothTurbines), 1, 0.05);
  EXPECT_NEAR(pixels_of(calendar, kOtherTurbine) / pixels_of(calendar, kBothTurbines), 1, 0.05);
}

TEST(FlickerCalendar, IsWhiteByDay) {
  FlickerCalendar calendar;
  for (std::uint32_t day = 0; day < 365; ++day) calendar.daylight.push_back({day * kMinutesOfDay + 480, 480});
  calendar.turbines = {flickering(kOneTurbine, 240, 270, 1)};  // the hours from four to sixteen are shown
  const double white = pixels_of(calendar, {255, 255, 255, 255}), night = pixels_of(calendar, kByNight);
  EXPECT_GT(white, 1.5 * night);
  EXPECT_GT(night, 10000);
}

TEST(FlickerCalendar, LastsADayLongerInLeapYears) {
  FlickerCalendar calendar;
  calendar.year = 2028;
  calendar.turbines = {flickering(kOneTurbine, 600, 660, 366)};
  EXPECT_EQ(pixels_of(calendar, kByNight), 0);
  EXPECT_GT(pixels_of(calendar, kOneTurbine), 100000);
}

TEST(FlickerCalendar, EqualCalendarsGiveEqualBytes) {
  FlickerCalendar calendar;
  calendar.title = "Shadow flicker", calendar.limit_minutes_day = 30;
  calendar.turbines = {flickering(kOneTurbine, 600, 640, 9)};
  for (const char* name : {"a.pdf", "a.png"})
    EXPECT_EQ(draw_flicker_calendar(calendar, name), draw_flicker_calendar(calendar, name));
  EXPECT_THROW(draw_flicker_calendar(calendar, "a.svg"), InputError);
}

TEST(DwellingSheets, TellOfRowsThatHaveNoRoom) {
  DwellingSheet sheet;
  sheet.title = "Dwelling 1", sheet.map.area = {0, 0, 1000, 1000};
  sheet.map.scale = scale_of_dwelling_map(sheet.map);
  sheet.facades.rows = sheet.turbines.rows = {{"a", "b"}};
  const auto drawn = [&](std::size_t rows) {
    sheet.facades.rows.resize(rows, {"1", "2"});
    return draw_dwelling_sheet(sheet, "a.png");
  };
  EXPECT_NE(drawn(2), drawn(3));
  EXPECT_NE(drawn(40), drawn(41)) << "the count of the rows left out is another";
  EXPECT_EQ(drawn(41), drawn(41));
}

TEST(DwellingSheets, HoldTheAreaInTheirMap) {
  MapSheet map;
  map.area = {300000, 200000, 301000, 202000};
  map.scale = scale_of_dwelling_map(map);
  const Box ground = ground_in_dwelling_map(map);
  EXPECT_LE(ground.ymin, 200000);
  EXPECT_GE(ground.ymax, 202000);
  EXPECT_NEAR((ground.xmin + ground.xmax) / 2, 300500, 1e-6);
  map.scale = 1000;
  EXPECT_THROW(scale_of_dwelling_map(map), InputError);
}

}  // namespace
}  // namespace itin::profile
