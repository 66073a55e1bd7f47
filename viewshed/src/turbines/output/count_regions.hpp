// The areas from which turbines are seen, by bands of their number, as polygons.
#pragma once

#include <string>

#include <itin/raster_regions.hpp>

#include "turbines/output/count_classes.hpp"

namespace itin::viewshed {

/// Returns the regions of the classes of a zone's cells but for the first, from which nothing is seen.
inline RegionLayer band_layer(const std::string& name, const Zone& zone, const CountClasses& counts) {
  constexpr std::uint8_t kOutsideBands = 255;
  RegionLayer layer{name, zone.grid, std::vector<std::uint8_t>(zone.grid.cell_count()), {}};
  for (std::size_t c = 1; c < counts.classes().size(); ++c)
    layer.classes.push_back({static_cast<std::uint32_t>(c), counts.classes()[c].label, counts.classes()[c].colour});
  for (std::size_t i = 0; i < layer.values.size(); ++i)
    layer.values[i] = static_cast<std::uint8_t>(counts.of(i).value_or(kOutsideBands));
  return layer;
}

}  // namespace itin::viewshed
