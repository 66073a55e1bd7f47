// The date that reports, maps on paper and years of the sun have where none is given.
#pragma once

#include <itin/calendar_day.hpp>

namespace itin::cli {

/// Returns the day on which the program runs, UTC, or the one that SOURCE_DATE_EPOCH gives.
/// Throws InputError where SOURCE_DATE_EPOCH is no number.
CalendarDay day_of_run();

}  // namespace itin::cli
