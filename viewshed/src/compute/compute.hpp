// The one ladder, where its result alone is wanted.
#pragma once

#include <itin/progress.hpp>
#include <itin/store.hpp>
#include <viewshed/viewshed.hpp>

namespace itin::viewshed {

/// What compute_with_surface() answers, where the surface itself is not wanted.
Result compute_result(const Store& store, const Request& request, ComputeOptions options, Progress& progress);

}  // namespace itin::viewshed
