// The raster of a viewshed as the command line writes it: with the store's CRS, the surface and the question in its
// metadata, and with a style for QGIS beside it where the mode has one.
//
//   write_result_raster("seen.tif", result, store.metadata(), {.certified = false, .overwrite = true}, progress);
//
// Through foliage it has two more beside it.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <itin/progress.hpp>
#include <itin/store.hpp>
#include <viewshed/foliage_view.hpp>
#include <viewshed/result.hpp>

namespace itin::viewshed {

struct ResultRasterOptions {
  bool certified = false;  ///< what is certain was asked for, by compute_certified()
  bool overwrite = false;
  std::string foliage = {};  ///< how woods are seen through; empty: they are solid
};

/// The command line's names of the modes, in their order; those of radio come last.
std::span<const std::string_view> mode_names();
/// The names of the modes that need no frequency.
std::span<const std::string_view> modes_of_sight();
/// Returns the command line's name of what cells have: "visible", "certified", "count", ...
std::string mode_name(Mode mode, bool certified);

/// Writes a GeoTIFF at `path` and, where has_qgis_style(), its style at style_beside(path). Throws FileError,
/// Cancelled.
void write_result_raster(const std::string& path, const Result& result, const StoreMetadata& metadata,
                         const ResultRasterOptions& options, const Progress& progress);

/// The files that write_foliage_rasters() writes beside a raster: NAME-foliage.tif and NAME-transmittance.tif beside
/// NAME.tif.
std::vector<std::string> foliage_rasters_beside(const std::string& raster);
/// Writes the metres of foliage on the line to each cell of a result, and the share of the light that comes through.
/// Throws FileError, Cancelled.
void write_foliage_rasters(const std::string& raster, const Result& result, const FoliageView& view,
                           const StoreMetadata& metadata, const ResultRasterOptions& options, const Progress& progress);

}  // namespace itin::viewshed
