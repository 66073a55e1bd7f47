// Finds places of a call that lie off the data, and what is likely to be wrong with them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <itin/data_extent.hpp>
#include <itin/geometry.hpp>
#include <itin/store.hpp>

#include "options/places/in_crs.hpp"

namespace itin::cli {

/// Returns nothing where `given` (in the CRS of --in-crs, else the store's) lies within the store's bounds. Otherwise
/// returns a text to follow the name of the place: that it lies off the data, the data's bounds, and the likely
/// mistake, such as coordinates that are swapped, or longitude and latitude without --in-crs.
std::optional<std::string> off_the_data(Point2 given, const InCrs& in_crs, const StoreMetadata& metadata);

/// The place in the store's CRS. Throws InputError, which begins with `what`, where it lies off the data.
Point2 on_the_data(const std::string& what, const Place& place, const InCrs& in_crs, const StoreMetadata& metadata);

/// Throws InputError, which begins with `what`, where `place` lies off the data. The place was read from a file, and is
/// in the store's CRS by now.
void require_on_the_data(const std::string& what, Point2 place, const InCrs& in_crs, const StoreMetadata& metadata);

/// Throws InputError, which begins with `first` (what the first place is called), where all places lie off the data.
void require_any_on_the_data(const std::string& first, const std::vector<Point2>& places, const InCrs& in_crs,
                             const StoreMetadata& metadata);

}  // namespace itin::cli
