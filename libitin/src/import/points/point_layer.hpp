// A layer of points in any vector format GDAL reads: GeoPackage, Shapefile, GeoJSON, ...
#pragma once

#include <memory>
#include <string>

#include <itin/import.hpp>

#include "import/source/point_reader.hpp"

namespace itin {

/// Opens a layer: the one that options.layer names, otherwise the file's only one. Points and multipoints give their Z,
/// or the attribute options.z_field; options.where selects features, in OGR's SQL. Features without geometry, and
/// heights that are null, are voids.
///
/// Throws FileError (not readable, no such layer or field, several layers and none named) and InputError (lines or
/// polygons, no heights at all, a where clause that is not understood); reading throws InputError for a coordinate that
/// is not finite, naming the feature.
std::unique_ptr<PointReader> open_point_layer(const std::string& path, const ImportOptions& options);

}  // namespace itin
