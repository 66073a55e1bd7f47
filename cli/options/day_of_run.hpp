// The date that reports and maps on paper have where none is given.
#pragma once

#include <string>

namespace itin::cli {

/// Returns the day on which the program runs, UTC, or the one that SOURCE_DATE_EPOCH gives, like "3 November 2026".
/// Throws InputError where SOURCE_DATE_EPOCH is no number.
std::string day_of_run();

}  // namespace itin::cli
