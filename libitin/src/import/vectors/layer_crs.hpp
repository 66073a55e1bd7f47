// The CRS that the places of a layer are in.
#pragma once

#include <string>

class OGRLayer;

namespace itin {

struct LayerCrs {
  std::string wkt;      ///< empty where the layer states none, and none is given
  std::string warning;  ///< says which one does not count, where the layer states another than the one given
};

/// Returns the layer's own CRS, or the one `given` where it states none, one that is not defined (QGIS's "Undefined"),
/// or degrees that its coordinates cannot be: GDAL takes all GeoJSON for degrees, whatever stands in it.
LayerCrs crs_of_layer(OGRLayer& layer, const std::string& path, const std::string& given);

}  // namespace itin
