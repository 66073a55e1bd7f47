// The result of compute_with_surface() alone.
#pragma once

#include <itin/progress.hpp>
#include <itin/store.hpp>
#include <viewshed/viewshed.hpp>

namespace itin::viewshed {

/// Returns the result of compute_with_surface(), where the surface itself is not wanted.
Result compute_result(const Store& store, const Request& request, ComputeOptions options, Progress& progress);

}  // namespace itin::viewshed
