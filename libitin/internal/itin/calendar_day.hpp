// Days as people write them.
//
//   const std::optional<CalendarDay> day = parse_day("23 November 2026");   // or "2026-11-23"
//   decimal_year(*day)                                                      // 2026.893
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <string_view>

namespace itin {

/// A day of the Gregorian calendar.
using CalendarDay = std::chrono::year_month_day;

/// Reads "2026-11-23", or day, month and year with the month in words, whole or by its first three letters, in any
/// case: "23 November 2026", "1 Mar 2027". Nothing where the text is no such day.
std::optional<CalendarDay> parse_day(std::string_view text);

/// Returns "23 November 2026".
std::string day_text(const CalendarDay& day);
/// Returns "2026-11-23".
std::string iso_day_text(const CalendarDay& day);

/// Returns the year plus the part of it that is over when the day begins.
double decimal_year(const CalendarDay& day);

}  // namespace itin
