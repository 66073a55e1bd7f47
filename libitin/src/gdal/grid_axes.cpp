#include <itin/grid_axes.hpp>

#include "gdal/crs.hpp"

namespace itin {

bool runs_east_north(const std::string& crs) {
  return parse_crs(crs, "CRS").east_north;
}

}  // namespace itin
