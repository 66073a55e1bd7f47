// The sheets of the dwellings that are asked for, as files.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <itin/progress.hpp>
#include <itin/store.hpp>
#include <viewshed/dwellings.hpp>

#include "workflows/dwellings/output/dwelling_calendar.hpp"

namespace itin::viewshed {

/// Returns the indices of the dwellings that sheets are asked for: all without names. A name may be an id instead, and
/// where no dwelling has it, a row of dwellings.csv. Throws InputError for any other.
std::vector<std::size_t> dwellings_of_sheets(const DwellingsSurvey& survey, const std::vector<std::string>& names);

/// Writes the sheets on the papers chosen, each as PDF and PNG, and returns the files by their names in the folder.
std::vector<PlanFile> write_dwelling_sheets(const std::string& folder, const Store& store,
                                            const DwellingsSurvey& survey, const CalendarMaker& calendars,
                                            const DwellingsFileOptions& options, Progress& progress);

}  // namespace itin::viewshed
