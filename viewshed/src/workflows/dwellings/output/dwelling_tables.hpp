// The survey of dwellings as tables and layers.
#pragma once

#include <cstddef>
#include <string>

#include <itin/vector_export.hpp>
#include <viewshed/dwellings.hpp>

namespace itin::viewshed {

/// How many dwellings there are, with flicker, beyond the limits, and with a blade tip in sight.
struct DwellingCounts {
  std::size_t all = 0, with_flicker = 0, over_year = 0, over_day = 0;
  std::size_t see_a_tip = 0, see_a_tip_screened = 0, see_a_tip_summer = 0, see_a_tip_winter = 0;
};
DwellingCounts counts_of(const DwellingsSurvey& survey);

/// A row for each dwelling: its flicker, which limits that exceeds, and what is seen from its facades together.
std::string dwellings_csv(const DwellingsSurvey& survey);
/// A row for each facade: what is seen from before it.
std::string facades_csv(const DwellingsSurvey& survey);
/// A row for each dwelling and turbine with flicker there.
std::string flicker_csv(const DwellingsSurvey& survey);
/// A row for each dwelling, turbine and stretch of minutes.
std::string calendar_csv(const DwellingsSurvey& survey);
/// The dwellings and the facades as layers, with the columns of their tables.
VectorLayer layer_of_dwellings(const DwellingsSurvey& survey);
VectorLayer layer_of_facades(const DwellingsSurvey& survey);

}  // namespace itin::viewshed
