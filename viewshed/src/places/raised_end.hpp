// How high the end of a line must be for nothing to hide it.
//
//   const ClearedEnd end = raised_end(surface, line);       // no lower than the line's own end
#pragma once

#include <cstdint>
#include <optional>

#include "line/sight_line.hpp"
#include "places/mount_places.hpp"

namespace itin::viewshed {

/// The end, and the triangle that asks for it: nothing where the line's own end is high enough.
struct ClearedEnd {
  double z = 0;  ///< grid units; infinity where the other end lies beneath the surface
  std::optional<std::uint32_t> triangle = {};
};

/// Raises the end of a line in grid units until nothing of the surface hides it.
ClearedEnd raised_end(const PlacedSurface& surface, const SightLine& line);

}  // namespace itin::viewshed
