#include <filesystem>

#include <fmt/format.h>

#include <itin/level_choice.hpp>
#include <itin/triangulate.hpp>
#include <viewshed/map_image.hpp>

#include "output/store_document.hpp"
#include "site/site_report.hpp"

namespace itin::cli {

namespace {

constexpr std::uint64_t kHillshadePoints = 400000;
constexpr int kMapPixels = 1100;

int hillshade_level(const Store& store, const RasterGrid& grid) {
  return finest_level_of(store, grid.bounds(), kHillshadePoints);
}

Tin hillshade_surface(const Store& store, const RasterGrid& grid, Progress& progress) {
  return triangulate(store, Window::box(grid.bounds()), detail_of(store.metadata(), hillshade_level(store, grid)),
                     progress);
}

/// The choice as a viewshed's result, which is what maps are drawn of.
viewshed::Result as_viewshed(const SiteResult& r) {
  viewshed::Result result;
  result.grid = r.rasters.grid;
  result.request.earth = r.options.earth.earth();
  result.request.radius = r.options.radius;
  result.request.target_height = r.options.target_height;
  for (const viewshed::ChosenSite& site : r.choice.chosen) {
    const viewshed::SitePosition& place = r.place_of(site);
    result.request.observers.push_back({place.name, place.position, place.height});
  }
  for (const std::uint16_t n : r.rasters.redundancy) {
    const bool outside = n == SiteRasters::kNoDemand, served = !outside && n >= r.options.cover;
    result.visible.push_back(outside  ? viewshed::Verdict::kOutside
                             : served ? viewshed::Verdict::kVisible
                                      : viewshed::Verdict::kHidden);
    ++(outside ? result.cells.outside : served ? result.cells.visible : result.cells.hidden);
  }
  return result;
}

}  // namespace

std::uint64_t bytes_of_site_maps(const Store& store, const RasterGrid& grid) {
  // Bytes per cell: its nearest server, how far that is, how many serve it, and copies of these to draw and to write.
  constexpr std::uint64_t kCell = 20, kPoint = 150;
  return kCell * grid.cell_count() + kPoint * store.points_about(hillshade_level(store, grid), grid.bounds());
}

void write_site_maps(const Store& store, const SiteResult& r, const std::string& directory, bool overwrite,
                     Progress& progress, std::vector<std::string>& warnings) {
  namespace fs = std::filesystem;
  progress.report("maps", 0);
  const Tin tin = hillshade_surface(store, r.rasters.grid, progress);
  viewshed::Result result = as_viewshed(r);
  viewshed::MapOptions options;
  options.map_pixels = kMapPixels;
  // Where demand is weighted, its area is another share than what is served.
  const bool of_area = r.options.demand != "cells";
  options.seen = of_area ? "Area served" : "Served", options.unseen = of_area ? "Area not served" : "Not served";
  options.observers = result.request.observers.size() == 1 ? "Site" : "Sites";
  options.outside = "Nothing to serve, or no data";
  options.title = fmt::format("Served by {}", counted(r.choice.chosen.size(), "site"));
  options.subtitle = fmt::format(
      "radius {:g} km, targets {:g} m up{}{}", r.options.radius / 1000, r.options.target_height,
      r.options.frequency_ghz ? fmt::format(", {:g} F1 clear at {:g} GHz", r.options.fresnel, *r.options.frequency_ghz)
                              : "",
      r.options.cover > 1 ? fmt::format(", by at least {} sites", r.options.cover) : "");
  const viewshed::MapImage coverage = draw_map(tin, result, options);
  warnings.insert(warnings.end(), coverage.warnings.begin(), coverage.warnings.end());
  write_image((fs::path(directory) / "coverage.png").string(), coverage, overwrite);
  result.request.mode = viewshed::Mode::kCount;
  result.count = r.rasters.redundancy;
  options.title = "Sites that serve a place";
  progress.report("maps", 0.5);
  write_image((fs::path(directory) / "redundancy.png").string(), draw_map(tin, result, options), overwrite);
}

}  // namespace itin::cli
