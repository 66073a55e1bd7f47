// Where a store's data lies, for messages about places that it does not hold.
#pragma once

#include <string>

#include <itin/geometry.hpp>
#include <itin/store.hpp>

namespace itin {

/// Tells whether a place in the store's CRS lies within the store's bounds.
bool is_on_the_data(Point2 place, const StoreMetadata& metadata);

/// Returns the store's bounds as text: "xmin,ymin to xmax,ymax in EPSG:27700".
std::string extent_of(const StoreMetadata& metadata);

}  // namespace itin
