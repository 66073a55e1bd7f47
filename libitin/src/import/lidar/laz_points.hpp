// Reads compressed LAS; only in builds with PDAL (ITIN_HAVE_PDAL).
#pragma once

#include "import/lidar/las_file.hpp"

namespace itin {

/// Reads all points of a LAZ file in its order, in bounded memory, on one thread. Throws FileError, and what the sink
/// throws.
void read_laz(const LasFile& file, const LasFile::Sink& sink);

}  // namespace itin
