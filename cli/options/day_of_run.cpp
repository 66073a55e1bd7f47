#include "options/day_of_run.hpp"

#include <chrono>
#include <cstdlib>
#include <ctime>

#include "program/values.hpp"

namespace itin::cli {

CalendarDay day_of_run() {
  std::time_t now = std::time(nullptr);
  if (const char* const given = std::getenv("SOURCE_DATE_EPOCH"))
    now = static_cast<std::time_t>(parse_number("SOURCE_DATE_EPOCH", given, Range::kNotNegative));
  return std::chrono::floor<std::chrono::days>(std::chrono::system_clock::from_time_t(now));
}

}  // namespace itin::cli
