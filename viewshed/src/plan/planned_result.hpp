// Results of a plan, which say of themselves what follows from the plan.
#pragma once

#include <cstddef>

#include <viewshed/plan.hpp>

namespace itin::viewshed {

/// Returns `result` as a segment of the plan: with the segment's request, and how certainly it was decided.
Result as_planned(const Plan& plan, std::size_t segment, Result result);

/// Says of a result of the plan how certainly it was decided.
void add_certainty(const Plan& plan, Result& result);

}  // namespace itin::viewshed
