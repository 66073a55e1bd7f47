// The points of a whole LAZ file.
#pragma once

#include <functional>
#include <span>
#include <string>

#include "import/lidar/laz/chunk_decoder.hpp"
#include "import/lidar/laz/chunk_table.hpp"

namespace itin {

using LazSink = std::function<void(std::span<const LazPoint> points)>;

/// Reads all points in the file's order, several chunks at a time on all threads. Memory: some tens of megabytes, and
/// the compressed bytes of a chunk that is larger. Throws FileError, and what the sink throws.
void read_laz(const std::string& path, const LazLayout& layout, const LazExtent& extent, const LazSink& sink);

}  // namespace itin
