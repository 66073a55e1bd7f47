#include "import/source/height_band.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <gdal_priv.h>

#include <itin/error.hpp>

#include "gdal/files/quiet_gdal.hpp"
#include "gdal/files/value_band.hpp"
#include "import/source/source_context.hpp"

namespace itin {

namespace {

void read_posts(GDALRasterBand& band, const std::string& path, const RasterWindow& w, void* out, GDALDataType type) {
  if (band.RasterIO(GF_Read, w.column, w.row, w.columns, w.rows, out, w.columns, w.rows, type, 0, 0, nullptr) !=
      CE_None)
    throw FileError(path, fmt::format("rows {} to {} cannot be read: {}", w.row, w.row + w.rows - 1,
                                      QuietGdal::message("GDAL does not say why")));
}

}  // namespace

HeightBand::HeightBand(GDALDataset& dataset, const std::string& path, std::optional<int> number)
    : path_(path),
      band_(&value_band(dataset, path, {.number = number})),
      scale_(band_->GetScale()),
      offset_(band_->GetOffset()) {
  int has_nodata = 0;
  const double nodata = band_->GetNoDataValue(&has_nodata);
  const int flags = band_->GetMaskFlags();
  mask_ = alpha_band(dataset);
  const bool own_mask = mask_ != nullptr || !(flags & GMF_NODATA);
  if (!mask_ && !(flags & GMF_ALL_VALID)) mask_ = band_->GetMaskBand();
  declares_nodata_ = has_nodata != 0;
  // A band's own mask hides the nodata value from GDAL's mask.
  if (declares_nodata_ && own_mask) nodata_ = nodata;
}

std::optional<LinearUnit> HeightBand::stated_unit() const {
  const std::string text = band_->GetUnitType();
  if (text.empty()) return std::nullopt;
  if (auto unit = linear_unit(text)) return unit;
  throw InputError(
      fmt::format("{}: the unit of heights, '{}', is not understood; give `crs` the CRS of heights in the right unit, "
                  "such as EPSG:5703 for metres",
                  path_, text),
      "crs");
}

int HeightBand::columns() const {
  return band_->GetXSize();
}

int HeightBand::rows() const {
  return band_->GetYSize();
}

void HeightBand::read(const RasterWindow& window, std::vector<double>& heights) {
  const QuietGdal quiet;
  heights.resize(window.posts());
  read_posts(*band_, path_, window, heights.data(), GDT_Float64);
  if (mask_) {
    valid_.resize(heights.size());
    read_posts(*mask_, path_, window, valid_.data(), GDT_Byte);
  }
  for (std::size_t i = 0; i < heights.size(); ++i) heights[i] = height(heights[i], !mask_ || valid_[i] != 0);
}

double HeightBand::height(double raw, bool valid) {
  constexpr double kVoid = std::numeric_limits<double>::quiet_NaN();
  if (!valid || std::isnan(raw) || raw == nodata_) return kVoid;
  // In a file that declares another value, -9999 could be the bottom of a trench.
  if (is_usual_nodata(raw) && (raw != -9999 || !declares_nodata_)) {
    ++undeclared_voids_;
    return kVoid;
  }
  return raw * scale_ + offset_;
}

}  // namespace itin
