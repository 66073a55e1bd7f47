#include "site/site_maps.hpp"

#include <fmt/format.h>

#include <itin/level_choice.hpp>
#include <itin/output_file.hpp>
#include <itin/parallel.hpp>
#include <itin/triangulate.hpp>
#include <viewshed/map_image.hpp>
#include <viewshed/missing_ground.hpp>
#include <viewshed/result_map.hpp>

#include "output/result_sheet.hpp"
#include "output/store_document.hpp"
#include "output/web_map.hpp"
#include "site/site_map_objects.hpp"
#include "site/site_wording.hpp"

namespace itin::cli {

namespace {

constexpr std::uint64_t kHillshadePoints = 400000;
constexpr int kMapPixels = 1100;
constexpr const char* kWithinRadius = "the area within the radius";

int hillshade_level(const Store& store, const RasterGrid& grid) {
  return finest_level_of(store, grid.bounds(), kHillshadePoints);
}

Tin hillshade_surface(const Store& store, const RasterGrid& grid, Progress& progress) {
  return triangulate(store, Window::box(grid.bounds()), detail_of(store.metadata(), hillshade_level(store, grid)),
                     progress);
}

viewshed::Result as_viewshed(const SiteResult& r) {
  viewshed::Result result;
  result.grid = r.rasters.grid;
  result.request.earth = r.options.earth.earth();
  result.request.radius = r.options.radius;
  result.request.target_height = r.options.target_height;
  // Where demand is a raster, only its cells count, whatever lies beyond within the radius.
  if (r.inputs.targets.grid && r.options.demand != "cells") result.request.grid = r.rasters.grid;
  for (const viewshed::ChosenSite& site : r.choice.chosen) {
    const viewshed::SitePosition& place = r.place_of(site);
    result.request.observers.push_back({place.name, place.position, place.height});
  }
  result.visible = r.rasters.served;
  const auto count = [&](viewshed::Verdict verdict) { return r.rasters.count(verdict); };
  using enum viewshed::Verdict;
  result.cells = {count(kVisible), count(kHidden), count(kUndecided), count(kOutside)};
  return result;
}

struct SiteMap {
  const char* name;
  viewshed::Result result;  ///< the choice in the form of a viewshed, from which maps are drawn
  viewshed::MapOptions options;
  viewshed::MissingGround missing = {};
};

/// Tells what the maps are for, in one line.
std::string subtitle_of(const SiteOptions& options) {
  const double kilometres = options.radius / 1000;
  if (options.placement.given())
    return fmt::format("{} {:g} m above the ground, eyes {:g} m, within {:g} km",
                       options.placement.minimised() == Minimised::kHubs ? "hubs" : "blade tips",
                       options.placement.minimised_height(), options.target_height, kilometres);
  return fmt::format(
      "radius {:g} km, targets {:g} m up{}{}", kilometres, options.target_height,
      options.frequency_ghz ? fmt::format(", {:g} F1 clear at {:g} GHz", options.fresnel, *options.frequency_ghz) : "",
      options.cover > 1 ? fmt::format(", by at least {} sites", options.cover) : "");
}

std::vector<SiteMap> site_maps(const Store& store, const SiteResult& r, Progress& progress) {
  viewshed::Result result = as_viewshed(r);
  const viewshed::MissingGround missing = viewshed::missing_ground(store, result, progress);
  viewshed::MapOptions options;
  options.no_data = viewshed::cells_without_ground(store, result, progress);
  if (missing.without_ground > 0) options.no_data_text = missing.key_text(kWithinRadius);
  options.map_pixels = kMapPixels;
  const SiteWording wording = wording_of(r.options);
  options.seen = wording.served, options.unseen = wording.unserved, options.shares = r.shares;
  options.observers = wording.mark + (result.request.observers.size() == 1 ? "" : "s");
  options.outside = "Beyond the radius, or no data";
  options.title = fmt::format("{} {}", wording.by, counted(r.choice.chosen.size(), wording.one));
  if (r.inputs.existing() > 0) options.title += fmt::format(" and {} existing", r.inputs.existing());
  options.subtitle = subtitle_of(r.options);
  std::vector<SiteMap> maps{{"coverage", result, options, missing}};
  result.request.mode = viewshed::Mode::kCount;
  result.values = viewshed::Counts{r.rasters.redundancy};
  options.title = wording.how_many;
  options.counts = r.options.placement.given() ? "Turbines" : "Served by sites";
  maps.push_back({"redundancy", std::move(result), std::move(options), missing});
  return maps;
}

ResultSheet sheet_of(const Store& store, const SiteResult& r, const SiteMap& map,
                     const std::vector<MapObjects>& objects, const std::vector<std::string>& sources,
                     Progress& progress) {
  const StoreMetadata& metadata = store.metadata();
  ResultSheet sheet{map.result.grid,
                    shown_area(r),
                    viewshed::result_map(map.result, map.options),
                    "Demand, and area within the radius",
                    in_cells(map.result.grid,
                             [&](std::size_t cell) { return map.result.visible[cell] != viewshed::Verdict::kOutside; }),
                    objects,
                    {}};
  sheet.missing =
      missing_on_sheet(viewshed::places_without_ground(store, map.result, progress), map.missing, kWithinRadius);
  sheet.outside = map.options.outside;
  sheet.title.title = map.options.title;
  sheet.title.statement = statement_of(metadata, r.options.themes.choice(), Detail::tolerance(0));
  const bool turbines = r.options.placement.given();
  const std::string one = wording_of(r.options).one;
  sheet.title.facts = {{turbines ? "Objective" : "Served", r.meaning()},
                       {turbines ? "Turbines" : "Targets", map.options.subtitle},
                       {"Choice", fmt::format("{}, {}", counted(r.choice.chosen.size(), one),
                                              turbines ? least_in_words(r) : served_in_words(r))},
                       {"Earth", r.options.earth.earth().convention()}};
  if (r.undecided > 0) sheet.title.facts.insert(sheet.title.facts.end() - 1, {"Undecided", undecided_in_words(r)});
  sheet.title.sources = sources;
  return sheet;
}

/// Returns a sheet for each map. The sheets refer to the maps.
std::vector<ResultSheet> sheets_of(const Store& store, const SiteResult& r, const std::vector<SiteMap>& maps,
                                   const std::vector<std::string>& sources, Progress& progress) {
  const std::vector<MapObjects> objects = site_map_objects(store, r);
  std::vector<ResultSheet> sheets;
  for (const SiteMap& map : maps) sheets.push_back(sheet_of(store, r, map, objects, sources, progress));
  return sheets;
}

}  // namespace

std::uint64_t bytes_of_site_maps(const Store& store, const RasterGrid& grid) {
  // Bytes per cell: its nearest server, the distance to it, how many serve the cell, and copies of these to draw and to
  // write.
  constexpr std::uint64_t kCell = 24, kPoint = 150;
  return kCell * grid.cell_count() + kPoint * store.points_about(hillshade_level(store, grid), grid.bounds());
}

void write_site_maps(const Store& store, const SiteResult& r, bool overwrite, Progress& progress,
                     std::vector<std::string>& warnings) {
  progress.report("maps", 0);
  const Tin tin = hillshade_surface(store, r.rasters.grid, progress);
  const std::vector<SiteMap> maps = site_maps(store, r, progress);
  parallel_for(maps.size(), [&](std::size_t i) {
    const viewshed::MapImage image = draw_map(tin, maps[i].result, maps[i].options);
    write_image(r.options.path(maps[i].name) + ".png", image, overwrite);
    // All maps are drawn with the same font, or without one, so that the warnings of the first one suffice.
    if (i == 0) warnings.insert(warnings.end(), image.warnings.begin(), image.warnings.end());
  });
}

std::vector<std::string> site_figures(const Store& store, const SiteResult& r, Progress& progress) {
  WebMaps web(store, shown_area(r), progress);
  const std::vector<SiteMap> maps = site_maps(store, r, progress);
  const std::vector<ResultSheet> sheets = sheets_of(store, r, maps, {}, progress);
  std::vector<std::string> figures;
  for (std::size_t i = 0; i < maps.size(); ++i) figures.push_back(web.figure(sheets[i], maps[i].options.subtitle));
  return figures;
}

void write_site_sheets(const Store& store, const SiteResult& r, const std::vector<std::string>& sources, bool overwrite,
                       Progress& progress) {
  if (!r.options.sheets.given()) return;
  const SheetOptions& options = r.options.sheets;
  const std::vector<SiteMap> maps = site_maps(store, r, progress);
  const std::vector<ResultSheet> sheets = sheets_of(store, r, maps, sources, progress);
  for (const profile::PaperSize paper : options.papers()) {
    const MapBase base = base_of(store, sheets.front(), paper, options, progress);
    for (std::size_t i = 0; i < maps.size(); ++i) {
      const profile::MapSheet sheet = map_sheet(store, sheets[i], base, paper, options);
      for (const std::string& name : sheet_names(maps[i].name, paper))
        write_file(r.options.path(name), profile::draw_map_sheet(sheet, name), overwrite);
    }
  }
}

}  // namespace itin::cli
