// The files of an import whose features stand on the ground.
#pragma once

#include <utility>
#include <vector>

#include <itin/import.hpp>
#include <itin/progress.hpp>

#include "import/footprints/footprint_reader.hpp"

namespace itin {

struct FootprintFile {
  FootprintSource footprints;
  std::uint64_t vertices = 0;  ///< number of vertices of all footprints and roofs
  /// The cells of a raster with a height and without one, and the cells known not to reach the threshold.
  std::uint64_t cells = 0, voids = 0, low_cells = 0;
  SourceInfo info;
};

/// Reads options.sources: CityJSON, rasters, or vector layers. Throws FileError, InputError, Cancelled.
std::vector<FootprintFile> read_footprint_files(const ImportOptions& options, const Store& store, Progress& progress);

/// The errors, in metres, by which cells of rasters imported with these options may stand lower, and higher, than they
/// should.
std::pair<double, double> height_error_of(const ImportOptions& options);

}  // namespace itin
