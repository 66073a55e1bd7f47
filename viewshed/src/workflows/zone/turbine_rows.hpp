// The table of the turbines.
#pragma once

#include <string>

#include <viewshed/zone_study.hpp>

namespace itin::viewshed {

/// Returns a row for each row of the turbines' file, as CSV: what was used, and why a row was not.
std::string turbine_rows(const ZoneStudy& study);

/// Returns "proposed", "consented" or "existing"; empty where the status is not known.
const char* planning_word(const Turbine& turbine);

}  // namespace itin::viewshed
