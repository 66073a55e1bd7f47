#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <gdal_priv.h>

#include <itin/error.hpp>
#include <itin/raster_values.hpp>

#include "gdal/files/quiet_gdal.hpp"
#include "gdal/files/raster_file.hpp"
#include "gdal/files/value_band.hpp"

namespace itin {

namespace {

/// Reads one row after the other.
class RasterRows {
 public:
  RasterRows(GDALDataset& dataset, GDALRasterBand& band, const std::string& path)
      : band_(band), path_(path), mask_(alpha_band(dataset)) {
    int has_nodata = 0;
    nodata_ = band.GetNoDataValue(&has_nodata);
    has_nodata_ = has_nodata != 0;
    if (!mask_ && !(band.GetMaskFlags() & GMF_ALL_VALID)) mask_ = band.GetMaskBand();
    valid_.resize(static_cast<std::size_t>(band.GetXSize()), 255);
  }

  void read(int row, double* values) {
    read(band_, row, values, GDT_Float64);
    if (mask_) read(*mask_, row, valid_.data(), GDT_Byte);
    for (std::size_t i = 0; i < valid_.size(); ++i) {
      // A dataset's own mask hides the nodata value from GDAL's mask.
      const bool missing = valid_[i] == 0 || (has_nodata_ && values[i] == nodata_);
      values[i] = missing ? std::numeric_limits<double>::quiet_NaN() : values[i] * band_.GetScale() + band_.GetOffset();
    }
  }

 private:
  void read(GDALRasterBand& band, int row, void* out, GDALDataType type) const {
    const int columns = band.GetXSize();
    if (band.RasterIO(GF_Read, 0, row, columns, 1, out, columns, 1, type, 0, 0, nullptr) != CE_None)
      throw FileError(path_,
                      fmt::format("row {} cannot be read: {}", row, QuietGdal::message("GDAL does not say why")));
  }

  GDALRasterBand& band_;
  const std::string& path_;
  GDALRasterBand* mask_;  // null where all cells are valid
  double nodata_ = 0;
  bool has_nodata_ = false;
  std::vector<unsigned char> valid_;
};

}  // namespace

RasterValues read_raster_values(const std::string& path, const std::string& crs_wkt) {
  RasterValues result{raster_grid_like(path, crs_wkt), {}};
  if (result.grid.cell_count() > (std::size_t{1} << 31))
    throw InputError(fmt::format("{}: has {} cells; resample it to fewer", path, result.grid.cell_count()));
  const QuietGdal quiet;
  const GDALDatasetUniquePtr dataset = open_raster_file(path);
  const BandQuery weights{std::nullopt, "weights", "give a raster of one, as gdal_translate -b makes it"};
  RasterRows reader(*dataset, value_band(*dataset, path, weights), path);
  result.values.resize(result.grid.cell_count());
  const auto columns = static_cast<std::size_t>(result.grid.columns());
  for (int row = 0; row < result.grid.rows(); ++row)
    reader.read(row, result.values.data() + static_cast<std::size_t>(row) * columns);
  return result;
}

}  // namespace itin
