// A cell of a grid as a box.
#pragma once

#include <cstddef>
#include <cstdint>

#include <itin/geometry.hpp>
#include <itin/raster.hpp>

namespace itin::viewshed {

/// By its index, metres.
inline Box cell_box(const RasterGrid& grid, std::size_t index) {
  const auto number = static_cast<std::int64_t>(index);
  const Point2 c = grid.centre(number % grid.columns(), number / grid.columns());
  const double w = grid.cell_width() / 2, h = grid.cell_height() / 2;
  return {c.x - w, c.y - h, c.x + w, c.y + h};
}

}  // namespace itin::viewshed
