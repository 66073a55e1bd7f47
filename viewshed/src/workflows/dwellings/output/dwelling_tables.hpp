// The survey of dwellings as tables.
#pragma once

#include <cstddef>
#include <string>

#include <viewshed/dwellings.hpp>

namespace itin::viewshed {

/// How many dwellings there are, with flicker, and beyond the limits.
struct DwellingCounts {
  std::size_t all = 0, with_flicker = 0, over_year = 0, over_day = 0;
};
DwellingCounts counts_of(const DwellingsSurvey& survey);

/// A row for each dwelling: its flicker, and which limits that exceeds.
std::string dwellings_csv(const DwellingsSurvey& survey);
/// A row for each dwelling and turbine with flicker there.
std::string flicker_csv(const DwellingsSurvey& survey);
/// A row for each dwelling, turbine and stretch of minutes.
std::string calendar_csv(const DwellingsSurvey& survey);

}  // namespace itin::viewshed
