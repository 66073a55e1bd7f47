// The cost of a viewshed at a tolerance, compared with that of the exact one.
#pragma once

#include <itin/store.hpp>
#include <viewshed/request.hpp>

namespace itin::viewshed {

/// Tells whether the exact answer is expected to take no longer than one at the request's tolerance. That is so over a
/// lattice, whose posts need no triangles, unless the tolerance leaves only a few of them. Reads the store's directory
/// and a few blocks. Returns false for a request of the exact answer, with rings, or with a theme that stands on the
/// ground, and for a lattice whose posts take more than the default of ComputeOptions::memory_bytes.
bool exact_costs_no_more(const Store& store, const Request& request);

}  // namespace itin::viewshed
