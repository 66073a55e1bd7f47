// A file of places: points in any vector format GDAL reads, or rows of a CSV file with columns of coordinates.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include <itin/coordinates.hpp>
#include <itin/geometry.hpp>
#include <itin/sites.hpp>

namespace itin {

/// Whether the types of a CSV file's columns are told by their values, or all columns but those of the position are
/// texts.
enum class ColumnTypes { kTexts, kDeclared };

/// Opens a file of places. Throws FileError. To be called within the life of a QuietGdal.
GDALDatasetUniquePtr open_place_file(const std::string& path, ColumnTypes types);

/// Finds where the features of a layer of such a file lie, in the CRS asked for.
class Places {
 public:
  /// The file must outlive it. Places are read in the layer's own CRS or, where it states none, in query.crs. Failing
  /// both, a CSV file headed longitude and latitude is in kGeographicColumnsCrs, and anything else in the wanted CRS.
  /// Throws InputError for a CRS that is unknown.
  Places(GDALDataset& file, OGRLayer& layer, const SiteQuery& query, const std::string& to_crs);

  /// Finds the place of a feature. Returns an empty text, or what is wrong with the place.
  std::string find(const OGRFeature& feature, Point2& place) const;

 private:
  std::string wrong_coordinate(const OGRFeature& feature) const;

  bool csv_;
  std::map<std::int64_t, std::string> wrong_rows_;  ///< what is wrong with rows of a CSV file, by their numbers
  std::vector<int> columns_;  ///< the fields of x and y in a CSV file; none where its header names no position
  std::optional<CoordinateTransform> transform_;
};

}  // namespace itin
