// A viewshed's result as files: rasters, polygons, and the JSON document.
//
//   const viewshed::Result result = viewshed::compute(store, request, progress);
//   viewshed::write_geotiff("out.tif", result, {.crs_wkt = store.metadata().crs_wkt});
//   viewshed::write_polygons("out.gpkg", result, store.metadata().crs_wkt, /*overwrite=*/false);
//   std::cout << viewshed::json_of(result, store.metadata()) << '\n';
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <itin/progress.hpp>
#include <itin/store.hpp>
#include <viewshed/result.hpp>

namespace itin::viewshed {

/// The JSON document that `itin viewshed --json` prints, without the call and its outputs. `metadata` is that of the
/// store that the result was computed on.
std::string json_of(const Result& result, const StoreMetadata& metadata);

struct GeotiffOptions {
  std::string crs_wkt = {};
  std::vector<std::pair<std::string, std::string>> metadata = {};  ///< added to what the request says of itself
  bool overwrite = false;
};

/// Writes the result with write_raster(). Byte: classes (Verdict, nodata 255; also for kFresnel). UInt16: counts
/// (nodata 65535). UInt32: bits without nodata (0 where none sees, a band for every 32 observers). Float32 (nodata
/// NaN): angles, bands of distance and number of the nearest, bands of both losses, and bands of the level, of its
/// margin over a sensitivity and of outages. Throws FileError, Cancelled.
void write_geotiff(const std::string& path, const Result& result, const GeotiffOptions& options,
                   const Progress& progress = NoProgress());

/// Writes what is seen as polygons to a GeoPackage or as GeoJSON, one per class as write_regions() does. The classes
/// are visible, hidden and undecided; in sight with the zone cut; one for every count, nearest observer or theme that
/// hides; the bands of levels, whose limits are the request's margins; and the cells where `no_data`, if it is given,
/// is 1. Throws FileError, and InputError as write_regions() does.
void write_polygons(const std::string& path, const Result& result, const std::string& crs_wkt, bool overwrite,
                    std::span<const std::uint8_t> no_data = {});

}  // namespace itin::viewshed
