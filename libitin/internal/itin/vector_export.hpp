// Small sets of points and lines, and regions of rasters, as GeoPackage layers and GeoJSON.
//
//   VectorLayer ends{"ends", VectorLayer::Shape::kPoints, {{"name", VectorLayer::Type::kText}}, {}};
//   ends.features.push_back({{{x, y, z}}, {std::string("A")}});
//   write_geopackage(path, store.metadata().crs_wkt, {ends}, false);
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <itin/geometry.hpp>
#include <itin/progress.hpp>
#include <itin/raster_regions.hpp>

namespace itin {

struct VectorLayer {
  enum class Shape { kPoints, kLines };
  enum class Type { kNumber, kWhole, kText };
  /// A value of a field; nothing where a feature has none.
  using Value = std::variant<std::monostate, double, std::int64_t, std::string>;
  struct Feature {
    std::vector<Point3> points;  ///< one for a point, at least two for a line
    std::vector<Value> values;   ///< as many as fields, of their types
  };

  std::string name;
  Shape shape = Shape::kPoints;
  std::vector<std::pair<std::string, Type>> fields;
  std::vector<Feature> features;
  std::string style = {};  ///< how QGIS draws the layer of a GeoPackage, as QML; empty: as it likes
};

/// Writes the layers, and their styles in the table in which QGIS looks for them; after them the regions, as
/// write_regions() has them. Equal calls write equal bytes. Throws FileError if the file exists and may not be
/// replaced, or cannot be written; Cancelled.
void write_geopackage(const std::string& path, const std::string& crs_wkt, const std::vector<VectorLayer>& layers,
                      bool overwrite, const Progress& progress = NoProgress(),
                      const std::vector<RegionLayer>& regions = {});

/// Writes in the CRS, named in the `crs` member of GeoJSON 2008. Throws as write_geopackage() does, and InputError for
/// a CRS without EPSG code.
void write_geojson(const std::string& path, const std::string& crs_wkt, const VectorLayer& layer, bool overwrite);

/// Throws InputError where the name ends in .geojson and the CRS has no EPSG code: for calls that work long before they
/// write.
void require_crs_for(const std::string& path, const std::string& crs_wkt);

}  // namespace itin
