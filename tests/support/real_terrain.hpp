// A piece of real terrain, read by GDAL straight from the shared data.
#pragma once

#include <cctype>
#include <cmath>
#include <filesystem>
#include <optional>
#include <string>
#include <tuple>
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

inline std::string os_terrain_50_path() {
  return std::string(ITIN_DATA_DIR) + "/os-terrain50-wales/tiles";
}

/// Four tiles of OS Terrain 50 about Pant y Wal, South Wales, 20 km square, or nothing where they are absent.
inline std::optional<Tin> pant_y_wal() {
  constexpr int kTile = 200, kSide = 2 * kTile;
  std::vector<double> z(std::size_t{kSide} * kSide);
  GDALAllRegister();
  for (const auto& [name, column, row] : {std::tuple{"ss88", 0, 0}, {"ss98", 1, 0}, {"ss89", 0, 1}, {"ss99", 1, 1}}) {
    std::string upper = name;
    for (char& c : upper) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    const std::string path = os_terrain_50_path() + "/" + name + ".zip";
    if (!std::filesystem::exists(path)) return std::nullopt;
    const GDALDatasetUniquePtr tile(
        GDALDataset::Open(("/vsizip/" + path + "/" + upper + ".asc").c_str(), GDAL_OF_RASTER));
    double* const north_west = z.data() + (std::size_t{kTile} * row + kTile - 1) * kSide + std::size_t{kTile} * column;
    // Rows are stored from the south upwards.
    if (!tile ||
        tile->GetRasterBand(1)->RasterIO(GF_Read, 0, 0, kTile, kTile, north_west, kTile, kTile, GDT_Float64,
                                         sizeof(double), -GSpacing{sizeof(double)} * kSide, nullptr) != CE_None)
      return std::nullopt;
  }
  return lattice_tin(kSide, kSide, 50,
                     [&](std::int32_t c, std::int32_t r) {
                       return z[static_cast<std::size_t>(r) * kSide + static_cast<std::size_t>(c)];
                     },
                     0.01, {280025, 180025});
}

}  // namespace itin::test
