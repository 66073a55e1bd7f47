// Cells of a map that are smaller than the pixels of its picture.
//
//   colours = averaged_cells(colours, {8000, 6000}, {1600, 1200});
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <itin/raster.hpp>

namespace itin::profile {

struct CellCounts {
  std::size_t columns = 0, rows = 0;
  friend bool operator==(const CellCounts&, const CellCounts&) = default;
};
inline CellCounts counts_of(const RasterGrid& grid) {
  return {static_cast<std::size_t>(grid.columns()), static_cast<std::size_t>(grid.rows())};
}

/// Returns fewer cells over the same area, row by row: each has the mean colour of what it takes the place of, so that
/// thin things grow pale instead of being lost. Precondition: `to` has no more columns and rows than `from`.
std::vector<Rgba> averaged_cells(std::span<const Rgba> colours, CellCounts from, CellCounts to);

}  // namespace itin::profile
