// A raster in the caller's memory: GDAL reads it there, without a copy.
//
//   const GDALDatasetUniquePtr raster = memory_raster(grid);
//   add_band(*raster, std::span(values), GDT_Byte);
#pragma once

#include <array>
#include <span>

#include <cpl_string.h>
#include <gdal_priv.h>

#include <itin/raster.hpp>

#include "gdal/files/drivers.hpp"

namespace itin {

/// Says where the raster's cells lie.
inline void place_on(const RasterGrid& grid, GDALDataset& raster) {
  std::array<double, 6> affine{grid.north_west().x, grid.cell_width(), 0, grid.north_west().y, 0, -grid.cell_height()};
  raster.SetGeoTransform(affine.data());
}

/// Makes a raster without bands, at the grid's place.
inline GDALDatasetUniquePtr memory_raster(const RasterGrid& grid) {
  GDALDatasetUniquePtr raster(written_driver("MEM")->Create("", static_cast<int>(grid.columns()),
                                                            static_cast<int>(grid.rows()), 0, GDT_Unknown, nullptr));
  place_on(grid, *raster);
  return raster;
}

/// Adds a band over values that must outlive the raster and are only read.
template <class T>
void add_band(GDALDataset& raster, std::span<const T> values, GDALDataType type) {
  std::array<char, 32> pointer{};
  CPLPrintPointer(pointer.data(), const_cast<T*>(values.data()), static_cast<int>(pointer.size()) - 1);
  CPLStringList options;
  options.SetNameValue("DATAPOINTER", pointer.data());
  raster.AddBand(type, options.List());
}

}  // namespace itin
