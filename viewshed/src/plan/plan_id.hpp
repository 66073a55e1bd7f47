// A number that tells a plan from every other one.
#pragma once

#include <cstdint>

#include <viewshed/plan.hpp>

namespace itin::viewshed {

/// Identifies all that the results of the plan's segments depend on.
std::uint64_t id_of(const StoreMetadata& store, const Plan& plan);

}  // namespace itin::viewshed
