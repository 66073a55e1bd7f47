// Viewsheds and horizons as JSON documents, in the names that stay.
#pragma once

#include <itin/document.hpp>
#include <viewshed/horizon.hpp>
#include <viewshed/viewshed.hpp>

namespace itin::viewshed {

/// How many of the cells within fields of view are decided.
double decided_percent(const CellCounts& cells);

/// `crs`, `surface`, `refraction`, `grid`, `cells`, `area_m2`, of a certified one `decided_percent`, and `statistics`.
Document viewshed_document(const StoreMetadata& metadata, const Result& result);

/// The horizon's targets.
Document targets_document(const Horizon& horizon);

}  // namespace itin::viewshed
