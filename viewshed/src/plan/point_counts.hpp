// About how many points a store's surface has under convex places.
#pragma once

#include <cstdint>
#include <vector>

#include <itin/raster.hpp>
#include <itin/store.hpp>
#include <itin/window.hpp>

namespace itin::viewshed {

class PointCounts {
 public:
  /// Counts the points of this level's surface within the box. Reads the directory of the store alone.
  PointCounts(const Store& store, int level, const Box& box);

  /// About as many points as a query of this window reads there, or more. The window's parts must be convex and have no
  /// holes.
  std::uint64_t within(const Window& window) const;

 private:
  RasterGrid cells_;
  std::vector<std::uint64_t> counts_;
};

}  // namespace itin::viewshed
