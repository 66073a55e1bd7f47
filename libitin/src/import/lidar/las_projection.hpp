// The CRS and the height unit that a LAS file's projection records stand for.
#pragma once

#include <optional>
#include <string>

#include "gdal/linear_unit.hpp"
#include "import/lidar/las_file.hpp"

namespace itin {

struct LasProjection {
  std::string crs;  ///< "EPSG:n" or WKT, with heights where keys name their CRS; empty if the file
                    ///< does not say
  std::optional<LinearUnit> height_unit;  ///< as key 4099 states it, which goes before the unit of the CRS
};

/// Reads the GeoTIFF keys (projected 3072, geographic 2048, vertical 4096, units 3076 and 4099) or the WKT, whichever
/// the header prefers if both are there. A linear unit that differs from the projected CRS's own overrides it, as in
/// GeoTIFF. User-defined keys (32767) without WKT say nothing. Throws FileError for units that are not known.
LasProjection las_projection(const LasFile& file);

}  // namespace itin
