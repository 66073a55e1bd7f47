// Tells how true lengths and directions in a store are.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <itin/grid_scale.hpp>
#include <itin/store.hpp>

namespace itin {

/// The scale of the store's CRS over its bounds; nothing where the CRS does not tell.
std::optional<GridScale> scale_of(const StoreMetadata& metadata);

/// Warns where lengths are not true, or axes do not run to the east and to the north, as in stores from before imports
/// refused that.
void warn_of_grid(const StoreMetadata& metadata, std::vector<std::string>& warnings);

}  // namespace itin
