// A number that tells a plan from every other one.
#pragma once

#include <cstdint>
#include <vector>

#include <viewshed/plan.hpp>

namespace itin::viewshed {

/// Of all that the results of its segments follow from.
std::uint64_t id_of(const StoreMetadata& store, const Request& request, const RasterGrid& grid,
                    const std::vector<Segment>& segments);

}  // namespace itin::viewshed
