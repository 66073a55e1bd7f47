// A file of places: points in any vector format GDAL reads, or rows of a CSV file with columns of coordinates.
#pragma once

#include <optional>
#include <string>

#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include <itin/coordinates.hpp>
#include <itin/geometry.hpp>

namespace itin {

/// Whether the types of a CSV file's columns are told by their values, or all are texts.
enum class ColumnTypes { kTexts, kTold };

/// Throws FileError. Within the life of a QuietGdal.
GDALDatasetUniquePtr open_place_file(const std::string& path, ColumnTypes types);

/// From the layer's own CRS or, where it says none, the given one; nothing where that is the wanted one or unknown.
std::optional<CoordinateTransform> transform_of_places(OGRLayer& layer, const std::string& given_crs,
                                                       const std::string& to_crs);

/// Where a feature of the file lies, in its own CRS; or, in place of nothing, what is wrong with that.
std::string read_place(GDALDataset& file, const OGRFeature& feature, Point2& place);

}  // namespace itin
