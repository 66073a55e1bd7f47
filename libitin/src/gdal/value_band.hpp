// Which band of a raster holds what is read from it.
#pragma once

#include <optional>
#include <string>

class GDALDataset;
class GDALRasterBand;

namespace itin {

struct BandQuery {
  std::optional<int> number;  ///< from 1; default: the only band, but for those that mask the others (alpha)
  // In messages: what the band should hold, and what to do where several could.
  std::string values = "heights";
  std::string advice = "say with `band` N which of them holds heights";
};

/// Throws InputError where several bands could be meant or the number is of none, FileError for a raster without bands,
/// and for complex numbers, colours of a palette and masks, which are no values, and a scale that makes none.
GDALRasterBand& value_band(GDALDataset& dataset, const std::string& path, const BandQuery& query);

/// The band that masks the others; null where there is none. GDAL heeds one by itself only where it holds whole numbers
/// of 8 or 16 bits.
GDALRasterBand* alpha_band(GDALDataset& dataset);

}  // namespace itin
