// The map about a dwelling and the plan of its walls, as its sheet shows them.
#pragma once

#include <vector>

#include <profile/map_sheet.hpp>
#include <viewshed/dwellings.hpp>
#include <viewshed/result_sheet.hpp>

namespace itin::viewshed {

/// The least area that the map shows: the dwelling, its nearest turbine, those within the survey's radius, and those
/// whose shadow flickers there.
Box area_about(const DwellingsSurvey& survey, const Dwelling& dwelling);

/// The dwelling, the turbines, those with flicker in the colours of the calendar, and the parts of the horizon that the
/// tips seen take up. Lines of sight end at the edge of `ground`.
std::vector<MapObjects> objects_about(const DwellingsSurvey& survey, const Dwelling& dwelling, const Box& ground);

/// The walls, with the facades by their numbers; an empty area for a place in the open.
profile::MapSheet plan_of(const Dwelling& dwelling, profile::PaperSize paper);

}  // namespace itin::viewshed
