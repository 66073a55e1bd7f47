#include <fmt/format.h>

#include <itin/coordinates.hpp>
#include <itin/grid_axes.hpp>
#include <itin/store_scale.hpp>

namespace itin {

std::optional<GridScale> scale_of(const StoreMetadata& metadata) {
  if (metadata.scale) return metadata.scale;
  return grid_scale_if_known(metadata.crs_wkt, metadata.grid.box(metadata.bounds));
}

void warn_of_grid(const StoreMetadata& metadata, std::vector<std::string>& warnings) {
  if (!runs_east_north(metadata.crs_wkt))
    warnings.push_back(fmt::format(
        "the axes of the store's CRS, {}, do not run to the east and to the north, so that azimuths, wedges "
        "and north arrows are turned; import the sources into a new store, which will have a UTM zone",
        crs_title(metadata.crs_wkt)));
  const auto scale = scale_of(metadata);
  if (!scale || scale->is_true()) return;
  warnings.push_back(
      fmt::format("lengths in the store's CRS, {}, are {}, and with them distances, angles and the Earth's curvature; "
                  "import the sources into a new store, which will have a UTM zone",
                  crs_title(metadata.crs_wkt), error_in_words(*scale)));
}

}  // namespace itin
