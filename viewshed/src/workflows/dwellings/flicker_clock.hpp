// Minutes of a year as days and times of a clock.
#pragma once

#include <cstdint>
#include <string>

#include <fmt/format.h>

#include <itin/calendar_day.hpp>
#include <viewshed/dwellings.hpp>

namespace itin::viewshed {

/// The day that is so many days after the first of the year.
inline CalendarDay day_of_year(int year, std::uint32_t day) {
  return std::chrono::sys_days{std::chrono::year{year} / 1 / 1} + std::chrono::days{day};
}

/// Returns a minute of a day as "07:30"; the day's end is "24:00".
inline std::string clock_text(std::uint32_t minute_of_day) {
  return fmt::format("{:02}:{:02}", minute_of_day / 60, minute_of_day % 60);
}

/// Returns "UTC", "UTC+1" or "UTC-3:30".
inline std::string clock_name(const FlickerYear& year) {
  const int ahead = year.utc_offset_minutes, minutes = ahead < 0 ? -ahead : ahead;
  if (ahead == 0) return "UTC";
  return fmt::format("UTC{}{}{}", ahead < 0 ? '-' : '+', minutes / 60,
                     minutes % 60 == 0 ? "" : fmt::format(":{:02}", minutes % 60));
}

}  // namespace itin::viewshed
