// The vertical part of a CRS, as GDAL understands it.
#pragma once

#include <optional>

#include <itin/height_axis.hpp>

class OGRSpatialReference;

namespace itin {

/// The datum of heights that are a coordinate of a geographic CRS, as of EPSG:4979.
inline constexpr const char* kEllipsoid = "the ellipsoid";

/// Returns the height axis of a compound, vertical or three-dimensional CRS; nothing where it has no vertical part.
std::optional<HeightAxis> vertical_axis(const OGRSpatialReference& reference);

}  // namespace itin
