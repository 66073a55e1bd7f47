// A piece of real terrain, read by GDAL straight from the shared data.
#pragma once

#include <cmath>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <gdal_priv.h>

#include "support/terrain_tin.hpp"

namespace itin::test {

inline std::string big_tujunga_path() {
  return std::string(ITIN_DATA_DIR) + "/dem30-misc/bigtujunga.tif";
}

/// side x side posts of the 30 m elevation model, or nothing where it is absent.
inline std::optional<Tin> big_tujunga(int column, int row, int side) {
  if (!std::filesystem::exists(big_tujunga_path())) return std::nullopt;
  GDALAllRegister();
  const GDALDatasetUniquePtr dataset(GDALDataset::Open(big_tujunga_path().c_str(), GDAL_OF_RASTER));
  if (!dataset) return std::nullopt;
  std::vector<double> z(static_cast<std::size_t>(side) * static_cast<std::size_t>(side));
  if (dataset->GetRasterBand(1)->RasterIO(GF_Read, column, row, side, side, z.data(), side, side, GDT_Float64, 0, 0,
                                          nullptr) != CE_None)
    return std::nullopt;
  return lattice_tin(side, side, 30, [&](std::int32_t c, std::int32_t r) {
    return z[static_cast<std::size_t>(side - 1 - r) * static_cast<std::size_t>(side) + static_cast<std::size_t>(c)];
  });
}

}  // namespace itin::test
