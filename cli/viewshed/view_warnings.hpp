// What a viewshed's reader has to know before believing it.
#pragma once

#include <string>
#include <vector>

#include <itin/store.hpp>
#include <viewshed/missing_ground.hpp>
#include <viewshed/result.hpp>

#include "viewshed/view_options.hpp"

namespace itin::cli {

/// Adds the result's own warnings, and those of missing ground, of views without cells, of the store's grid, and of
/// light that stands for radio.
void add_view_warnings(const StoreMetadata& metadata, const ViewOptions& view, const viewshed::Result& result,
                       const viewshed::MissingGround& missing, std::vector<std::string>& warnings);

}  // namespace itin::cli
