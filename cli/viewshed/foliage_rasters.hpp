// The rasters that `itin viewshed --foliage` writes beside that of the verdicts.
#pragma once

#include <string>

#include <itin/progress.hpp>
#include <itin/store.hpp>
#include <viewshed/foliage_view.hpp>

#include "viewshed/viewshed_outputs.hpp"

namespace itin::cli {

/// Claims NAME-foliage.tif and NAME-transmittance.tif for each raster NAME.tif of -o. Throws as claim_beside() does.
void claim_foliage_rasters(ViewshedOutputs& outputs);
/// Writes them; `foliage` says how woods are seen through. Throws FileError, Cancelled.
void write_foliage_rasters(const ViewshedOutputs& outputs, const StoreMetadata& metadata,
                           const viewshed::ThroughFoliage& through, const std::string& foliage,
                           const Progress& progress);

}  // namespace itin::cli
