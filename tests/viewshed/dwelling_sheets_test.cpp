// Calendars and sheets of dwellings: when the sun is up, whose minutes are drawn, and which sheets are written.
#include "workflows/dwellings/output/dwelling_sheets.hpp"

#include <filesystem>

#include <gtest/gtest.h>

#include <itin/error.hpp>
#include <itin/import.hpp>
#include <viewshed/dwellings.hpp>

#include "support/houses.hpp"
#include "support/raster_file.hpp"
#include "support/temporary_directory.hpp"
#include "workflows/dwellings/daylight.hpp"
#include "workflows/dwellings/output/dwelling_calendar.hpp"

namespace itin::viewshed {
namespace {

constexpr std::uint32_t kMinutesADay = SunYear::kMinutesOfDay;

/// The daylight of one day of the year, from 0.
std::vector<profile::CalendarMinutes> daylight_of(std::uint32_t day, const FlickerYear& year, const SkyAt& sky) {
  std::vector<profile::CalendarMinutes> runs;
  for (const profile::CalendarMinutes& run : daylight_at(SunYear(year, NoProgress()), sky))
    if (run.first / kMinutesADay == day) runs.push_back({run.first % kMinutesADay, run.count});
  return runs;
}

// The example of NREL's SPA in Golden, Colorado: on 17 October 2003 the sun rises at 06:12:43. It sets at 17:20:19, by
// the universal date: that is the evening before.
TEST(Daylight, IsFromSunriseToSunset) {
  const SkyAt sky({-105.1786, 39.742476}, 1830.14);
  const FlickerYear year{2003, -7 * 60};
  const auto day = daylight_of(289, year, sky), before = daylight_of(288, year, sky);
  ASSERT_EQ(day.size(), 1U);
  ASSERT_EQ(before.size(), 1U);
  EXPECT_NEAR(day[0].first, 6 * 60 + 12.7, 1);
  EXPECT_NEAR(before[0].first + before[0].count, 17 * 60 + 20.3, 1);
}

TEST(Daylight, LastsAllDayOrNotAtAllBeyondThePolarCircle) {
  const SkyAt sky({20, 69}, 0);
  const auto june = daylight_of(171, {2027, 60}, sky);
  ASSERT_EQ(june.size(), 1U);
  EXPECT_EQ(june[0].count, kMinutesADay);
  EXPECT_TRUE(daylight_of(354, {2027, 60}, sky).empty());
}

TEST(Daylight, IsInTwoPartsWhereTheClockIsFarOff) {
  const auto runs = daylight_of(171, {2027, 0}, SkyAt({180, 40}, 0));
  ASSERT_EQ(runs.size(), 2U);
  EXPECT_EQ(runs[0].first, 0U);
  EXPECT_EQ(runs[1].first + runs[1].count, kMinutesADay);
}

class SheetsOfDwellings : public testing::Test {
 protected:
  SheetsOfDwellings() {
    test::write_raster(directory_.file("t.tif"), {400000, 201000, 20, 101, 51, 27700}, [](int, int) { return 50.0; });
    ImportOptions terrain;
    terrain.sources = {directory_.file("t.tif")};
    import_terrain(path_, terrain, progress_);
  }

  static Turbine turbine(std::size_t number, Point2 position) {
    return {.number = number, .position = position, .tip_height = 140, .hub_height = 90, .rotor_diameter = 100};
  }

  /// Places in the open between turbines.
  DwellingsSurvey survey(const std::vector<Point2>& turbines) {
    DwellingsRequest request;
    for (const Point2& at : turbines)
      request.turbines.turbines.push_back(turbine(request.turbines.turbines.size() + 1, at));
    request.dwellings.places = {{.name = "2", .position = {400800, 200500}},
                                {.name = "mill", .position = {400850, 200520}},
                                {.name = "mill", .position = {400900, 200540}}};
    return survey_dwellings(Store(path_), request, progress_);
  }

  static std::uint32_t minutes_in(const profile::FlickerCalendar& calendar) {
    std::uint32_t minutes = 0;
    for (const profile::CalendarTurbine& t : calendar.turbines)
      for (const profile::CalendarMinutes& run : t.flicker) minutes += run.count;
    return minutes;
  }

  test::TemporaryDirectory directory_;
  const std::string path_ = directory_.file("s.itin");
  NoProgress progress_;
};

TEST_F(SheetsOfDwellings, CalendarsHaveTheMinutesOfEachTurbine) {
  const DwellingsSurvey found = survey({{401300, 200400}, {401250, 200450}});
  const CalendarMaker calendars(found, progress_);
  const Dwelling& dwelling = found.dwellings[0];
  const auto coloured = coloured_turbines(dwelling);
  ASSERT_EQ(coloured.size(), 2U);
  EXPECT_GE(coloured[0].minutes, coloured[1].minutes);
  EXPECT_NE(coloured[0].colour, coloured[1].colour);
  const profile::FlickerCalendar calendar = calendars.of(dwelling);
  ASSERT_EQ(calendar.turbines.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    const auto runs = flicker_runs(dwelling, coloured[i].turbine);
    ASSERT_EQ(calendar.turbines[i].flicker.size(), runs.size());
    EXPECT_EQ(calendar.turbines[i].flicker[0].first, runs[0].first);
    EXPECT_EQ(calendar.turbines[i].colour, coloured[i].colour);
  }
  EXPECT_GE(minutes_in(calendars.of_all()), minutes_in(calendar));
  EXPECT_FALSE(calendars.of_all().limit_minutes_day) << "limits are those of a dwelling";
}

TEST_F(SheetsOfDwellings, FurtherTurbinesShareAColourAndTheirMinutesStay) {
  std::vector<Point2> ring;
  for (int i = 0; i < 12; ++i) ring.push_back({401300 - 20.0 * i, 200200 + 60.0 * i});
  const DwellingsSurvey found = survey(ring);
  const auto coloured = coloured_turbines(found.dwellings[0]);
  ASSERT_GT(coloured.size(), 8U);
  const profile::FlickerCalendar calendar = CalendarMaker(found, progress_).of(found.dwellings[0]);
  ASSERT_EQ(calendar.turbines.size(), 8U);
  EXPECT_EQ(calendar.turbines.back().name, std::to_string(coloured.size() - 7) + " more turbines");
  std::uint32_t minutes = 0;
  for (const ColouredTurbine& t : coloured) minutes += t.minutes;
  EXPECT_EQ(minutes_in(calendar), minutes);
}

TEST_F(SheetsOfDwellings, AreThoseOfANameAnIdOrElseARow) {
  const DwellingsSurvey found = survey({{401300, 200400}});
  using Indices = std::vector<std::size_t>;
  EXPECT_EQ(dwellings_of_sheets(found, {}), (Indices{0, 1, 2}));
  EXPECT_EQ(dwellings_of_sheets(found, {"mill"}), (Indices{1, 2}));
  EXPECT_EQ(dwellings_of_sheets(found, {"2"}), (Indices{0})) << "a name comes before a row";
  EXPECT_EQ(dwellings_of_sheets(found, {"3", "2"}), (Indices{0, 2}));
  EXPECT_THROW(dwellings_of_sheets(found, {"4"}), InputError);
}

TEST_F(SheetsOfDwellings, AreWrittenOnThePapersChosen) {
  const DwellingsSurvey found = survey({{401300, 200400}});
  DwellingsFileOptions options;
  options.sheets.papers = {profile::PaperSize::kA3, profile::PaperSize::kA1};
  options.sheets_of = {"mill"};
  const std::string folder = directory_.file("out");
  const auto files = write_dwellings(folder, Store(path_), found, options, progress_);
  for (const char* name : {"sheet-2-mill-A3.pdf", "sheet-2-mill-A1.png", "sheet-3-mill-A3.png", "calendar.png"}) {
    EXPECT_GT(std::filesystem::file_size(folder + "/" + name), 10000U) << name;
    EXPECT_EQ(
        std::count_if(files.begin(), files.end(), [&](const PlanFile& f) { return f.path == folder + "/" + name; }), 1);
  }
  EXPECT_FALSE(std::filesystem::exists(folder + "/sheet-1-2-A3.pdf"));
}

TEST_F(SheetsOfDwellings, AreRefusedBeforeAnythingIsWritten) {
  const DwellingsSurvey found = survey({{401300, 200400}});
  DwellingsFileOptions options;
  options.sheets.papers = {profile::PaperSize::kA3};
  options.sheets_of = {"castle"};
  EXPECT_THROW(write_dwellings(directory_.file("out"), Store(path_), found, options, progress_), InputError);
  EXPECT_FALSE(std::filesystem::exists(directory_.file("out")));
}

}  // namespace
}  // namespace itin::viewshed
