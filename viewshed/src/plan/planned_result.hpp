// Results of a plan: what they say of themselves follows from the plan.
#pragma once

#include <cstddef>

#include <viewshed/plan.hpp>

namespace itin::viewshed {

/// The rasters of `result` as the plan's segment: with its request, and how certainly they were decided.
Result as_planned(const Plan& plan, std::size_t segment, Result result);

/// Says of a result of the plan how certainly it was decided.
void add_certainty(const Plan& plan, Result& result);

}  // namespace itin::viewshed
