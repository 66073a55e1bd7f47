// Chooses the band of a raster that holds the values to read.
#pragma once

#include <optional>
#include <string>

class GDALDataset;
class GDALRasterBand;

namespace itin {

struct BandQuery {
  std::optional<int> number;  ///< from 1; default: the only band besides masks (alpha)
  // These are for messages: what the band should hold, and what to do where several bands could.
  std::string values = "heights";
  std::string advice = "say with `band` N which of them holds heights";
};

/// Returns the band that the query asks for. Throws InputError where several bands could be meant or there is no band
/// of that number. Throws FileError for a raster without bands, for complex numbers, for colours of a palette and
/// masks, which are no values, and for a scale that makes none.
GDALRasterBand& value_band(GDALDataset& dataset, const std::string& path, const BandQuery& query);

/// Returns the band that masks the others; null where there is none. GDAL itself heeds such a band only where it holds
/// whole numbers of 8 or 16 bits.
GDALRasterBand* alpha_band(GDALDataset& dataset);

}  // namespace itin
