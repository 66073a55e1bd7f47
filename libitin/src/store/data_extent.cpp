#include <fmt/format.h>

#include <itin/crs_words.hpp>
#include <itin/data_extent.hpp>
#include <itin/grid_units.hpp>

namespace itin {

bool is_on_the_data(Point2 p, const StoreMetadata& metadata) {
  const auto [x, y] = place_in_units(metadata.grid, p);
  const GridBox& bounds = metadata.bounds;
  return x >= bounds.xmin && x <= bounds.xmax && y >= bounds.ymin && y <= bounds.ymax;
}

std::string extent_of(const StoreMetadata& metadata) {
  const Box bounds = metadata.grid.box(metadata.bounds);
  return fmt::format("{:.10g},{:.10g} to {:.10g},{:.10g} in {}", bounds.xmin, bounds.ymin, bounds.xmax, bounds.ymax,
                     crs_in_short(metadata.crs_wkt));
}

}  // namespace itin
