// The files of an import whose features stand on the ground.
#pragma once

#include <vector>

#include <itin/import.hpp>
#include <itin/progress.hpp>

#include "import/footprints/footprint_reader.hpp"

namespace itin {

struct FootprintFile {
  FootprintSource footprints;
  std::uint64_t vertices = 0;  ///< of all footprints and roofs
  SourceInfo info;
};

/// Reads options.sources: CityJSON, or vector layers. Throws FileError, InputError, Cancelled.
std::vector<FootprintFile> read_footprint_files(const ImportOptions& options, const StoreMetadata& store,
                                                Progress& progress);

}  // namespace itin
