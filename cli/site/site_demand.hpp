// The demand of a siting run: cells in reach of the candidates, a raster of weights, or points.
#pragma once

#include <itin/progress.hpp>
#include <itin/store.hpp>

#include "site/site_inputs.hpp"

namespace itin::cli {

/// Adds the demand to inputs that have their options and positions. Throws InputError where there is no demand,
/// FileError.
void read_site_demand(const Store& store, const SiteOptions& options, SiteInputs& inputs, Progress& progress);

}  // namespace itin::cli
