// The vertices and lines that make way for the raised features above them.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "pyramid/theme_lines.hpp"
#include "store/codec/point_index.hpp"
#include "store/store_writer.hpp"

namespace itin {

struct WrittenParts {
  std::vector<Segment> masked;                     ///< segments that make way, as in parts' edge trees (FORMAT.md)
  std::map<std::uint16_t, PartClusters> clusters;  ///< by number of part
};

/// Writes the vertices of all parts, with the positions where vertices of the terrain, of lines on the ground
/// (`draped`) and of parts of greater rank make way for them. `ground` has the full surface's points and no others.
/// Returns the given segments that make way.
WrittenParts write_parts(const ThemeLines& lines, const PointIndex& ground, const std::vector<GridPoint>& draped,
                         const std::vector<Segment>& segments, StoreWriter& writer, Progress& progress);

}  // namespace itin
