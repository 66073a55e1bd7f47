// Exact answers from the full surface, within a given memory, for every mode.
#pragma once

#include <itin/progress.hpp>
#include <itin/store.hpp>
#include <viewshed/certified.hpp>
#include <viewshed/viewshed.hpp>

namespace itin::viewshed {

/// As compute_precise(), in mode kCertified too: there only what is seen across ground without data is undecided, under
/// NoData::kUnknown. Throws as that.
Surveyed compute_exactly(const Store& store, const Request& request, const PreciseOptions& options, Progress& progress);

}  // namespace itin::viewshed
