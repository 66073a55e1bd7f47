// The tables of viewpoints.
#pragma once

#include <string>

#include <viewshed/zone_study.hpp>

namespace itin::viewshed {

/// Returns a row for each viewpoint and turbine, as CSV.
std::string viewpoint_table(const ZoneStudy& study);
/// Returns a row for each viewpoint, as CSV.
std::string viewpoint_summary(const ZoneStudy& study);

}  // namespace itin::viewshed
