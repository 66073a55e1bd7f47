// One dwelling's sheet of paper: what is told and drawn there.
#pragma once

#include <cstddef>

#include <itin/progress.hpp>
#include <itin/store.hpp>
#include <profile/dwelling_sheet.hpp>
#include <profile/sheet_choice.hpp>
#include <viewshed/dwellings.hpp>

#include "workflows/dwellings/output/dwelling_calendar.hpp"

namespace itin::viewshed {

/// What all sheets of a survey share.
struct SheetOfSurvey {
  const Store& store;
  const DwellingsSurvey& survey;
  const CalendarMaker& calendars;
  const profile::SheetChoice& choice;
};

/// Returns "Dwelling 7: the mill".
std::string sheet_title(const DwellingsSurvey& survey, std::size_t dwelling);

/// Makes the sheet of a dwelling, by its index. Throws FileError (a basemap), InputError (a scale that is too large),
/// Cancelled.
profile::DwellingSheet dwelling_sheet(const SheetOfSurvey& of, std::size_t dwelling, profile::PaperSize paper,
                                      Progress& progress);

}  // namespace itin::viewshed
