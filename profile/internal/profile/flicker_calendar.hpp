// A year of shadow flicker as a calendar: days across, hours up, each minute in the colour of the turbine whose shadow
// it is, between sunrise and sunset.
//
//   profile::FlickerCalendar calendar;
//   calendar.title = "Shadow flicker at the mill", calendar.clock = "UTC+1";
//   calendar.daylight = {{480, 490}}, calendar.turbines = {{"turbine 3", {0, 114, 178, 255}, {{540, 12}}}};
//   write("calendar.png", profile::draw_flicker_calendar(calendar, "calendar.png"));
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <itin/raster.hpp>

namespace itin::profile {

/// Minutes one after the other on one day; the first is counted from the beginning of the year.
struct CalendarMinutes {
  std::uint32_t first = 0, count = 0;
};

struct CalendarTurbine {
  std::string name;  ///< as the legend has it
  Rgba colour;
  std::vector<CalendarMinutes> flicker;
};

struct FlickerCalendar {
  std::string title, note;  ///< over the calendar and below it; either may be empty
  int year = 2027;
  std::string clock;                             ///< by which the minutes are, as "UTC+1"
  std::vector<CalendarMinutes> daylight;         ///< from sunrise to sunset; days end them
  std::vector<CalendarTurbine> turbines;         ///< those with flicker
  std::optional<double> limit_minutes_day = {};  ///< days with more are marked
};

/// Draws the calendar by itself: .pdf or .png by the name's ending. Equal calendars give equal bytes. Throws InputError
/// for another ending.
std::string draw_flicker_calendar(const FlickerCalendar& calendar, const std::string& path);

}  // namespace itin::profile
