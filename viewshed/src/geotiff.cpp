#include <fmt/format.h>

#include <viewshed/certified.hpp>
#include <viewshed/viewshed.hpp>

namespace itin::viewshed {

namespace {

std::string observers_text(const std::vector<Observer>& observers) {
  std::string text;
  for (const Observer& o : observers) {
    if (!text.empty()) text += ' ';
    text += fmt::format("{:.12g},{:.12g},{:.12g}", o.position.x, o.position.y, o.height);
  }
  return text;
}

std::string nodata_text(NoData rule) {
  switch (rule) {
    case NoData::kUnknown:
      return "unknown";
    case NoData::kBlock:
      return "block";
    case NoData::kClear:
      return "clear";
  }
  return {};
}

std::vector<std::pair<std::string, std::string>> metadata_of(const Result& result) {
  const Request& r = result.request;
  std::vector<std::pair<std::string, std::string>> items{{"observers", observers_text(r.observers)},
                                                         {"target_height_m", fmt::format("{:.12g}", r.target_height)},
                                                         {"nodata_rule", nodata_text(r.nodata)},
                                                         {"refraction", r.earth.convention()},
                                                         {"error_bound_m", fmt::format("{:.3g}", result.error_bound_m)},
                                                         {"cells", "decided at their centres"}};
  if (r.radius) items.emplace_back("radius_m", fmt::format("{:.12g}", *r.radius));
  if (r.min_radius > 0) items.emplace_back("min_radius_m", fmt::format("{:.12g}", r.min_radius));
  if (r.azimuth) items.emplace_back("azimuth_deg", fmt::format("{:.12g},{:.12g}", r.azimuth->from, r.azimuth->to));
  if (r.elevation)
    items.emplace_back("elevation_deg", fmt::format("{:.12g},{:.12g}", r.elevation->from, r.elevation->to));
  return items;
}

}  // namespace

void write_geotiff(const std::string& path, const Result& result, const GeotiffOptions& options) {
  RasterDescription description;
  description.crs_wkt = options.crs_wkt;
  description.overwrite = options.overwrite;
  description.metadata = metadata_of(result);
  description.metadata.insert(description.metadata.end(), options.metadata.begin(), options.metadata.end());
  if (result.request.mode == Mode::kCount) {
    description.band_name = "observers that see the cell";
    description.nodata = kCountOutside;
    write_raster(path, result.grid, std::span<const std::uint16_t>(result.count), description);
  } else if (result.request.mode == Mode::kCertified) {
    description.band_name = "certified";
    description.nodata = kOutside;
    description.classes = {{kUndecided, "undecided at this tolerance", 230, 159, 0, 255},
                           {kCertainlyHidden, "certainly hidden", 225, 225, 225, 255},
                           {kCertainlyVisible, "certainly visible", 0, 114, 178, 255},
                           {kOutside, "outside or no data", 0, 0, 0, 0}};
    write_raster(path, result.grid, std::span<const std::uint8_t>(result.visible), description);
  } else {
    description.band_name = "visible";
    description.nodata = kOutside;
    description.classes = {{kHidden, "hidden", 225, 225, 225, 255},
                           {kVisible, "visible", 0, 114, 178, 255},
                           {kOutside, "outside or no data", 0, 0, 0, 0}};
    write_raster(path, result.grid, std::span<const std::uint8_t>(result.visible), description);
  }
}

}  // namespace itin::viewshed
