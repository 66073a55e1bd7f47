// The band of a raster that holds heights.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "gdal/linear_unit.hpp"

class GDALDataset;
class GDALRasterBand;

namespace itin {

struct RasterWindow {
  int column = 0, row = 0, columns = 0, rows = 0;
  std::uint64_t posts() const { return static_cast<std::uint64_t>(columns) * static_cast<std::uint64_t>(rows); }
};

/// A band with everything that makes its numbers heights: scale, offset, nodata, mask. The dataset must outlive it.
class HeightBand {
 public:
  /// Chooses the band as value_band() does. Throws FileError where the raster holds no heights, InputError where it is
  /// not clear which band does.
  HeightBand(GDALDataset& dataset, const std::string& path, std::optional<int> number);

  /// The unit the band states; nothing where it states none. Throws InputError for an unknown unit.
  std::optional<LinearUnit> stated_unit() const;

  int columns() const;
  int rows() const;
  bool declares_nodata() const { return declares_nodata_; }

  /// Reads heights in the band's unit, row by row, NaN where there is none. Throws FileError.
  void read(const RasterWindow& window, std::vector<double>& heights);

  /// The number of posts read so far with a value that customarily stands for missing data though the file does not
  /// declare it.
  std::uint64_t undeclared_voids() const { return undeclared_voids_; }

  const std::string& path() const { return path_; }
  GDALRasterBand& band() const { return *band_; }

 private:
  double height(double raw, bool valid);

  std::string path_;
  GDALRasterBand* band_;
  GDALRasterBand* mask_ = nullptr;  // null where all posts are valid
  std::optional<double> nodata_;    // where the mask does not know the nodata value
  bool declares_nodata_ = false;
  double scale_ = 1, offset_ = 0;
  std::vector<unsigned char> valid_;
  std::uint64_t undeclared_voids_ = 0;
};

}  // namespace itin
