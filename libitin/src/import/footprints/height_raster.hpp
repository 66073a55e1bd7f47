// Reads rasters of heights whose cells stand on the ground: canopies, buildings, digital surface models.
//
//   HeightRasterQuery query;
//   query.path = "canopy.tif";
//   query.step = query.threshold = 2;
//   HeightRaster raster = read_height_raster(query, store.metadata(), progress);
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include <itin/progress.hpp>
#include <itin/store.hpp>

#include "import/footprints/footprint_reader.hpp"
#include "import/source/vertical_datums.hpp"

namespace itin {

/// Parts of rasters have this many columns and rows of cells, but the last ones.
inline constexpr int kHeightPartSide = 64;

struct HeightRasterQuery {
  std::string path;
  std::string crs;                 ///< overrides the raster's own
  std::optional<int> band;         ///< default: the only one
  bool absolute = false;           ///< whether values are elevations; else they are heights above the ground
  double step = 2, threshold = 2;  ///< metres: whole millimetres
  HeightRounding rounding = HeightRounding::nearest;
  VerticalDatums* datums = nullptr;  ///< elevations must share their datum; null: they need not
  std::uint64_t memory_bytes = 0;
};

struct HeightRaster {
  FootprintSource footprints;  ///< features of the kind `cells`, each with a part of the raster, row by row
  std::uint64_t cells = 0;     ///< number of cells with a height
  std::uint64_t voids = 0;     ///< number of cells without one
  std::uint64_t low = 0;       ///< number of cells below the threshold; 0 for elevations, as that is not known here
};

/// Reads a raster. Heights are in the unit of the band, else as source_heights() tells. Parts without any height are
/// left out; among heights above the ground those of cells that do not stand count as none. Throws FileError for a file
/// that cannot be read or holds no height. Throws InputError for a step or threshold out of range, a raster in another
/// CRS than the store, elevations on another datum, heights above the ground of more than 1000 m, cells that are all
/// lower than the threshold, and more cells than the memory has room for. Throws Cancelled.
HeightRaster read_height_raster(const HeightRasterQuery& query, const StoreMetadata& store, Progress& progress);

}  // namespace itin
