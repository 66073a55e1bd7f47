// Where the chunks of a LAZ file are, and how many points each has.
#pragma once

#include <cstdint>
#include <vector>

#include "base/file_bytes.hpp"
#include "import/lidar/laz/laz_layout.hpp"

namespace itin {

struct LazChunk {
  std::uint64_t offset = 0, bytes = 0;
  std::uint64_t points = 0;
};

/// Where the points of a file are.
struct LazExtent {
  std::uint64_t offset = 0;  ///< where the point data begin, with the place of the chunk table
  std::uint64_t points = 0;
};

/// Reads the chunk table. Throws FileError where it is damaged, or does not fit the number of points or the file's
/// size, so that all chunks are parts of the file and have room for their first point.
std::vector<LazChunk> chunk_table(FileBytes& bytes, const LazLayout& layout, const LazExtent& extent);

}  // namespace itin
