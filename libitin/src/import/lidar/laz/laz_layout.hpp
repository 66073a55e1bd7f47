// What the points of a LAZ file consist of, as its LASzip record says.
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace itin {

/// Who compressed what, and how; see laz_layout().
struct LazLayout {
  bool layered = false;             ///< point formats 6 to 10: each attribute has bytes of its own
  bool times = false;               ///< points that are not layered have GPS times
  bool colours = false;             ///< likewise, colours
  std::uint32_t extra_bytes = 0;    ///< likewise, so many extra bytes
  std::uint32_t layers = 0;         ///< the number of layers of points that are layered
  std::uint32_t record_length = 0;  ///< bytes of a point that is not compressed
  std::uint32_t chunk_points = 0;   ///< points of a chunk, of which the last has fewer; 0: the chunk table counts them
};

/// A point format, and the bytes that a point of it has in this file.
struct LazRecord {
  int format = 0;
  std::uint32_t length = 0;
};

/// Reads the LASzip record (user "laszip encoded", id 22204). Point formats 0 to 3 and 6 to 10 are read, as LASzip 2
/// and later write them. Throws FileError for others, and for a record that is damaged or does not fit the point
/// format.
LazLayout laz_layout(const std::string& path, std::span<const char> record, const LazRecord& point);

}  // namespace itin
