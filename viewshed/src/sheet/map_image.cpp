#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include <itin/error.hpp>
#include <itin/filling_grid.hpp>
#include <viewshed/map_image.hpp>
#include <viewshed/result_sheet.hpp>
#include <viewshed/surface.hpp>

#include "bounds/pixel_heights.hpp"
#include "drawing/hillshade.hpp"

namespace itin::viewshed {

namespace {

std::string length_text(double metres) {
  return metres >= 1000 ? fmt::format("{:.10g} km", metres / 1000) : fmt::format("{:.10g} m", metres);
}

void require_possible(const MapOptions& options) {
  if (options.map_pixels < 200 || options.map_pixels > 16000)
    throw InputError(fmt::format("map of {} pixels: give 200 to 16000", options.map_pixels), "map_pixels");
}

/// The name of an observer, where it has one that is more than its number, and its place.
std::string observer_text(const Observer& observer) {
  return fmt::format("{} at {:.10g}, {:.10g},", is_named(observer) ? observer.name : "Observer", observer.position.x,
                     observer.position.y);
}

std::string subtitle_of(const Result& result) {
  const Request& r = result.request;
  const Observer& first = r.observers.front();
  const bool alike = std::all_of(r.observers.begin(), r.observers.end(), [&](const Observer& o) {
    return o.height == first.height && o.absolute == first.absolute;
  });
  std::string text = r.observers.size() == 1 ? observer_text(first) : counted_observers(r.observers);
  const auto height = [](double metres, bool absolute, bool on_surface) {
    const char* const above = on_surface ? "above the surface" : "above ground";
    return fmt::format("{} {:g} m {}", absolute ? " at" : "", metres, absolute ? "elevation" : above);
  };
  if (alike) text += height(first.height, first.absolute, r.observers_on_surface);
  if (r.mode != Mode::kHeight) text += ", target" + height(r.target_height, r.target_absolute, r.targets_on_surface);
  if (r.radius) text += ", within " + length_text(*r.radius);
  text += fmt::format("; cells of {}", length_text(result.grid.cell_width()));
  return text;
}

profile::TitleBlock title_of(const Result& result, const MapOptions& options) {
  profile::TitleBlock title;
  title.title = options.title;
  title.statement = options.subtitle.empty() ? subtitle_of(result) : options.subtitle;
  if (!options.statement.empty()) {
    title.facts.emplace_back("View", title.statement);
    title.statement = options.statement;
  }
  title.facts.insert(title.facts.end(), options.facts.begin(), options.facts.end());
  title.facts.emplace_back("Earth", result.request.earth.convention());
  if (!options.beyond_text.empty()) title.facts.emplace_back("Beyond the ground data", options.beyond_text);
  title.sources = options.sources;
  return title;
}

ResultSheet content_of(const Result& result, const MapOptions& options) {
  ResultSheet content;
  content.grid = result.grid, content.area = result.grid.bounds();
  content.map = result_map(result, options);
  content.studied = in_cells(result.grid, [&](std::size_t cell) { return result.visible[cell] != Verdict::kOutside; });
  content.objects.push_back(observer_objects(result.request.observers, options.observers));
  content.title = title_of(result, options);
  content.outside = options.outside;
  if (std::find(options.no_data.begin(), options.no_data.end(), 1) != options.no_data.end())
    content.missing = {in_cells(result.grid, [&](std::size_t cell) { return options.no_data[cell] == 1; }),
                       options.no_data_text};
  return content;
}

/// heights_of(pixels) returns the heights of the ground.
template <class HeightsOf>
MapImage drawn_map(const HeightsOf& heights_of, const Result& result, const MapOptions& options) {
  require_possible(options);
  ResultSheet content = content_of(result, options);
  const RasterGrid pixels = filling_grid(content.area, options.map_pixels);
  MapBase base = plain_base(hillshade(pixels, heights_of(pixels)));
  // The surface is no larger than what was looked at.
  if (!base.clear.empty()) base.clear = "Not looked at, or no terrain data";
  return draw_result_picture(base, std::move(content), options.crs_wkt);
}

}  // namespace

MapImage draw_result_picture(const MapBase& plain, ResultSheet content, const std::string& crs_wkt) {
  const RasterGrid& grid = plain.picture.grid;
  const int pixels = static_cast<int>(std::max(grid.columns(), grid.rows()));
  const MapBase base = fitted(plain, content, profile::void_stripe_pixels(pixels));
  profile::MapSheet sheet;
  sheet.area = content.area, sheet.crs_wkt = crs_wkt;
  sheet.legend = keys_of(base, content, content.area);
  sheet.title = content.title;
  sheet.layers = layers_of(base, std::move(content));
  const profile::MapPicture picture = profile::draw_map_picture(sheet, pixels);
  return {picture.width, picture.height, {picture.rgb.begin(), picture.rgb.end()}};
}

MapImage draw_map(const Tin& tin, const Result& result, const MapOptions& options) {
  return drawn_map([&](const RasterGrid& pixels) { return heights_at(tin, pixels); }, result, options);
}

MapImage draw_map(RetrievedSurface& surface, const Result& result, Progress& progress, const MapOptions& options) {
  if (!surface.lattice) return draw_map(surface.tin, result, options);
  surface.lattice->read_all(progress);
  const LatticeTin& lattice = surface.lattice->lattice();
  return drawn_map([&](const RasterGrid& pixels) { return heights_at(lattice, pixels); }, result, options);
}

}  // namespace itin::viewshed
