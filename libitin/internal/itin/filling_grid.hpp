// Grids that fill a box, whatever the size of their cells.
//
//   const RasterGrid pixels = filling_grid(frame, 1600);
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <itin/raster.hpp>

namespace itin {

inline RasterGrid filling_grid(const Box& box, std::int64_t columns, std::int64_t rows) {
  return {{box.xmin, box.ymax},
          box.width() / static_cast<double>(columns),
          box.height() / static_cast<double>(rows),
          columns,
          rows};
}

/// Returns the grid with so many cells along the box's longer side, which are about square.
inline RasterGrid filling_grid(const Box& box, std::int64_t longer) {
  const double cell = std::max(box.width(), box.height()) / static_cast<double>(longer);
  const auto count = [&](double length) { return std::max<std::int64_t>(1, std::llround(length / cell)); };
  return filling_grid(box, count(box.width()), count(box.height()));
}

}  // namespace itin
