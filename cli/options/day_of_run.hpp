// The date that reports and maps on paper bear where none is given.
#pragma once

#include <string>

namespace itin::cli {

/// "3 November 2026": the day on which the program runs, UTC, or the one that SOURCE_DATE_EPOCH gives. Throws
/// InputError where that is no number.
std::string day_of_run();

}  // namespace itin::cli
