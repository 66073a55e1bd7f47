// Reads footprints from vector layers: polygons in any format GDAL reads, lines as bands about them.
//
//   FootprintQuery query;
//   query.path = "buildings.gpkg";
//   query.height_field = "height";
//   FootprintSource source = read_footprints(query, store_crs_wkt, grid);
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <itin/geometry.hpp>
#include <itin/progress.hpp>

#include "import/source/layers/kept_features.hpp"
#include "import/source/vertical_datums.hpp"
#include "store/segments/footprint.hpp"

namespace itin {

/// The meaning of the Z of a footprint's vertices.
enum class FootprintZ {
  ignored,
  base,  ///< the least of them is the base, unless base_field says otherwise
  top    ///< the greatest of them is the elevation of the roof, unless height_field says otherwise; needs a base
};

struct FootprintQuery {
  std::string path;
  std::string layer;             ///< default: the file's only layer
  std::string where;             ///< in OGR's SQL; default: all features
  std::string height_field;      ///< height of the highest point above the base
  std::string eaves_field;       ///< height of the eaves above the base
  std::string base_field;        ///< elevation of the base; default: left to the terrain
  FeatureQuery kept;             ///< a feature without a name is called "feature" and its number in the file
  std::string crs;               ///< overrides the layer's own
  std::optional<double> storey;  ///< metres; height_field and eaves_field count storeys of this height
  std::optional<double> height;  ///< metres; for features that have none in height_field
  FeatureKind kind = FeatureKind::building;
  RoofKind roof = RoofKind::flat;
  FootprintZ z = FootprintZ::ignored;
  double thickness = 0.3;            ///< thickness of bands about lines, metres
  VerticalDatums* datums = nullptr;  ///< those of other sources, whose datum the bases must share; null: they need not
};

struct FootprintSource {
  std::vector<FootprintFeature> features;  ///< in the file's order
  std::vector<AttributeField> fields;      ///< the fields that are kept of the features
  std::vector<FeatureRecord> records;      ///< one for each feature; none where nothing is kept
  std::string crs;                         ///< as found or given
  std::uint64_t filtered = 0;              ///< number of features left out by `where`
  std::vector<std::string> warnings;       ///< one line each: features that were passed over, units assumed
};

/// Reads footprints, in the CRS `to_crs` (WKT). Heights are in the unit of the CRS's vertical part or axes, which may
/// be feet, unless a text states its own (written_height.hpp). The base is a depth where the vertical part has depths;
/// heights above it never are. A feature whose height is null has none. Throws FileError for a file, layer, field or
/// filter that is missing or not readable, InputError for a CRS that is missing or unknown, Cancelled.
FootprintSource read_footprints(const FootprintQuery& query, const std::string& to_crs, const Grid& grid,
                                Progress& progress);

}  // namespace itin
