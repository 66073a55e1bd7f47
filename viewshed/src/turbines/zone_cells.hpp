// The cells of a zone that have values, whether it holds these or has them part by part.
//
//   for_each_cell_with_value(zone, zone.bare, [&](const Visibility& seen, std::size_t cell, std::size_t of_zone) {
//     tips += seen.tip_count[cell];
//   });
#pragma once

#include <viewshed/result_parts.hpp>
#include <viewshed/turbines.hpp>

namespace itin::viewshed {

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
