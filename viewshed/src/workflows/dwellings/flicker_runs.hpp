// Minutes of flicker in runs that days end.
#pragma once

#include <vector>

#include <viewshed/dwellings.hpp>

namespace itin::viewshed {

/// Joins runs of one day that touch or overlap. They are given in the order of their first minutes.
std::vector<FlickerRun> joined_runs(const std::vector<FlickerRun>& runs);

}  // namespace itin::viewshed
