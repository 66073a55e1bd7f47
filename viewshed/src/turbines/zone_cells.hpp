// The cells of a zone, whether it holds all that is told of them or has it part by part.
//
//   for_each_part(zone, [&](const Zone& part, RasterGrid::Cell north_west) { count(part.bare.turbines); });
#pragma once

#include <viewshed/turbines.hpp>

namespace itin::viewshed {

/// Calls use(part, north_west) for each part of a zone. One that holds its cells is its own only part.
template <class Use>
void for_each_part(const Zone& zone, const Use& use) {
  if (!zone.parts) return use(zone, RasterGrid::Cell{});
  zone.parts->for_each(use);
}

/// Returns what a part of the zone has over the surface that `seen` is of: zone.bare, or *zone.screened.
inline const Visibility& of_same_surface(const Zone& zone, const Visibility& seen, const Zone& part) {
  return &seen == &zone.bare ? part.bare : part.screened.value();
}

/// Calls use(seen, cell, cell_of_zone) for each cell that has values over the surface that `all` is of: what its part
/// has, and the cell's number in the part and in the zone.
template <class Use>
void for_each_cell_with_value(const Zone& zone, const Visibility& all, const Use& use) {
  for_each_part(zone, [&](const Zone& part, RasterGrid::Cell at) {
    const Visibility& seen = of_same_surface(zone, all, part);
    for (std::int64_t row = 0; row < part.grid.rows(); ++row) {
      std::size_t cell = part.grid.index({0, row}), of_zone = zone.grid.index({at.column, at.row + row});
      for (std::int64_t column = 0; column < part.grid.columns(); ++column, ++cell, ++of_zone)
        if (seen.tip_count[cell] != kCountOutside) use(seen, cell, of_zone);
    }
  });
}

}  // namespace itin::viewshed
