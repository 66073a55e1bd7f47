#include "gdal/files/value_band.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gdal_priv.h>

#include <itin/error.hpp>

namespace itin {

namespace {

bool is_mask(GDALRasterBand& band) {
  return band.GetColorInterpretation() == GCI_AlphaBand;
}

/// Returns "1 (Red)", "2 (canopy height)".
std::string title_of(GDALRasterBand& band) {
  const std::string description = band.GetDescription();
  const GDALColorInterp colour = band.GetColorInterpretation();
  const bool coloured = colour != GCI_Undefined && colour != GCI_GrayIndex;
  if (description.empty() && !coloured) return fmt::format("{}", band.GetBand());
  return fmt::format("{} ({})", band.GetBand(),
                     description.empty() ? GDALGetColorInterpretationName(colour) : description.c_str());
}

GDALRasterBand& only_band(GDALDataset& dataset, const std::string& path, const BandQuery& query) {
  std::vector<GDALRasterBand*> bands;
  for (GDALRasterBand* band : dataset.GetBands())
    if (!is_mask(*band)) bands.push_back(band);
  if (bands.size() == 1) return *bands.front();
  if (bands.empty()) throw FileError(path, fmt::format("holds a mask alone, and no {}", query.values));
  constexpr std::size_t kMostNamed = 6;
  std::vector<std::string> titles;
  for (std::size_t i = 0; i < std::min(bands.size(), kMostNamed); ++i) titles.push_back(title_of(*bands[i]));
  throw InputError(fmt::format("{}: has {} bands, {}{}; {}", path, bands.size(), fmt::join(titles, ", "),
                               bands.size() > kMostNamed ? ", ..." : "", query.advice));
}

GDALRasterBand& chosen_band(GDALDataset& dataset, const std::string& path, int number, const std::string& values) {
  const int count = dataset.GetRasterCount();
  if (number < 1 || number > count)
    throw InputError(fmt::format("{}: has no band {}, only {}; give another `band`", path, number,
                                 count == 1 ? std::string("band 1") : fmt::format("bands 1 to {}", count)),
                     "band");
  GDALRasterBand& band = *dataset.GetRasterBand(number);
  if (is_mask(band)) throw FileError(path, fmt::format("band {} is a mask, and holds no {}", number, values));
  return band;
}

}  // namespace

GDALRasterBand* alpha_band(GDALDataset& dataset) {
  for (GDALRasterBand* band : dataset.GetBands())
    if (is_mask(*band)) return band;
  return nullptr;
}

GDALRasterBand& value_band(GDALDataset& dataset, const std::string& path, const BandQuery& query) {
  if (dataset.GetRasterCount() == 0) {
    const char* subdataset = dataset.GetMetadataItem("SUBDATASET_1_NAME", "SUBDATASETS");
    throw FileError(path, subdataset ? fmt::format("holds several rasters; name one of them, such as {}", subdataset)
                                     : std::string("holds no raster band"));
  }
  GDALRasterBand& band =
      query.number ? chosen_band(dataset, path, *query.number, query.values) : only_band(dataset, path, query);
  if (GDALDataTypeIsComplex(band.GetRasterDataType()))
    throw FileError(path, fmt::format("holds complex numbers, not {}", query.values));
  if (const double scale = band.GetScale(); !std::isfinite(scale) || scale == 0 || !std::isfinite(band.GetOffset()))
    throw FileError(path,
                    fmt::format("a scale of {} and an offset of {} make no {}", scale, band.GetOffset(), query.values));
  if (band.GetColorTable()) throw FileError(path, fmt::format("holds colours of a palette, not {}", query.values));
  return band;
}

}  // namespace itin
