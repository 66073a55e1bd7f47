// The table of the turbines.
#pragma once

#include <string>

#include <viewshed/zone_study.hpp>

namespace itin::viewshed {

/// Returns a row for each row of the turbines' file, as CSV: what was used, and why a row was not.
std::string turbine_rows(const ZoneStudy& study);

}  // namespace itin::viewshed
