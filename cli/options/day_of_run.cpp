#include "options/day_of_run.hpp"

#include <cstdlib>
#include <ctime>

#include <fmt/chrono.h>

#include "program/values.hpp"

namespace itin::cli {

std::string day_of_run() {
  std::time_t now = std::time(nullptr);
  if (const char* const given = std::getenv("SOURCE_DATE_EPOCH"))
    now = static_cast<std::time_t>(parse_number("SOURCE_DATE_EPOCH", given, Range::kNotNegative));
  return fmt::format("{} {:%B %Y}", fmt::gmtime(now).tm_mday, fmt::gmtime(now));
}

}  // namespace itin::cli
