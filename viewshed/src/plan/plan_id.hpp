// A number that tells a plan from every other one.
#pragma once

#include <cstdint>

#include <viewshed/plan.hpp>

namespace itin::viewshed {

/// Tells a store from others by what was imported, and what became of it; not by when it was imported.
std::uint64_t id_of(const StoreMetadata& store);

/// Identifies all that the results of the plan's segments depend on.
std::uint64_t id_of(const StoreMetadata& store, const Plan& plan);

}  // namespace itin::viewshed
