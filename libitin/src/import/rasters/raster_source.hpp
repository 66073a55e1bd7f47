// Rasters of heights, of any format GDAL reads, as sources of terrain: one point per post, at the centre of its cell.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <itin/import.hpp>

#include "import/source/source_context.hpp"

class GDALDataset;

namespace itin {

/// Ground reaches across this number of steps between posts: a missing post leaves a hole, a diagonal does not.
inline constexpr double kGapSteps = 1.5;

/// Returns the CRS as WKT 2; empty where the raster does not say its CRS.
std::string crs_text(const GDALDataset& dataset);

/// Returns the rasters that `path` stands for: itself, or those inside a .zip in order of name; none where GDAL sees no
/// raster in it. Text of scattered points is no raster, even where GDAL would grid it.
std::vector<std::string> find_rasters(const std::string& path);

/// Opens the band options.band, or else the only one (value_band.hpp), with its scale, offset, nodata and mask. Heights
/// keep their exact values: nothing is resampled. Nodata, masked posts and NaN are voids. So are, with a warning,
/// values that customarily stand for missing data though the file does not declare them.
///
/// After reading, SourceInfo::gap_basis holds 1.5 times the longest steps between posts met at the raster's corners and
/// centre. Throws FileError (unreadable, damaged, several datasets), InputError (no georeference, no CRS, several
/// bands).
std::unique_ptr<SourceFile> open_raster_source(const std::string& path, const ImportOptions& options);

}  // namespace itin
