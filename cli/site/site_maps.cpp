#include "site/site_maps.hpp"

#include <fmt/format.h>

#include <itin/level_choice.hpp>
#include <itin/output_file.hpp>
#include <itin/parallel.hpp>
#include <itin/triangulate.hpp>
#include <viewshed/map_image.hpp>
#include <viewshed/missing_ground.hpp>
#include <viewshed/result_map.hpp>
#include <viewshed/site_maps.hpp>
#include <viewshed/site_wording.hpp>

#include "output/result_sheet.hpp"
#include "output/store_document.hpp"
#include "output/web_map.hpp"
#include "site/site_map_objects.hpp"
#include "site/site_wording.hpp"

namespace itin::cli {

namespace {

constexpr int kMapPixels = 1100;
constexpr const char* kWithinRadius = "the area within the radius";

Tin hillshade_surface(const Store& store, const RasterGrid& grid, Progress& progress) {
  return triangulate(store, Window::box(grid.bounds()),
                     detail_of(store.metadata(), viewshed::hillshade_level(store, grid)), progress);
}

viewshed::Result as_viewshed(const viewshed::SitePlan& r) {
  viewshed::Result result;
  result.grid = r.rasters.grid;
  result.request.earth = r.request.earth;
  result.request.radius = r.request.radius;
  result.request.target_height = r.request.demand.height;
  // Where demand is a raster, only its cells count, whatever lies beyond within the radius.
  if (r.request.demand.grid) result.request.grid = r.rasters.grid;
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
std::string subtitle_of(const viewshed::SitePlanRequest& request) {
  const double kilometres = request.radius / 1000;
  if (request.turbines)
    return fmt::format("{} {:g} m above the ground, eyes {:g} m, within {:g} km",
                       request.turbines->minimised == viewshed::Minimised::kHubs ? "hubs" : "blade tips",
                       request.turbines->minimised_height(), request.demand.height, kilometres);
  return fmt::format(
      "radius {:g} km, targets {:g} m up{}{}", kilometres, request.demand.height,
      request.frequency_ghz ? fmt::format(", {:g} F1 clear at {:g} GHz", request.fresnel, *request.frequency_ghz) : "",
      request.cover > 1 ? fmt::format(", by at least {} sites", request.cover) : "");
}

std::vector<SiteMap> site_maps(const Store& store, const viewshed::SitePlan& r, Progress& progress) {
  viewshed::Result result = as_viewshed(r);
  const viewshed::MissingGround missing = viewshed::missing_ground(store, result, progress);
  viewshed::MapOptions options;
  options.no_data = viewshed::cells_without_ground(store, result, progress);
  if (missing.without_ground > 0) options.no_data_text = missing.key_text(kWithinRadius);
  options.map_pixels = kMapPixels;
  const viewshed::SiteWording wording = viewshed::wording_of(r.request);
  options.seen = wording.served, options.unseen = wording.unserved, options.shares = r.shares;
  options.observers = wording.mark + (result.request.observers.size() == 1 ? "" : "s");
  options.outside = "Beyond the radius, or no data";
  options.title = fmt::format("{} {}", wording.by, counted(r.choice.chosen.size(), wording.one));
  if (r.inputs.existing() > 0) options.title += fmt::format(" and {} existing", r.inputs.existing());
  options.subtitle = subtitle_of(r.request);
  std::vector<SiteMap> maps{{"coverage", result, options, missing}};
  result.request.mode = viewshed::Mode::kCount;
  result.values = viewshed::Counts{r.rasters.redundancy};
  options.title = wording.how_many;
  options.counts = r.request.turbines ? "Turbines" : "Served by sites";
  maps.push_back({"redundancy", std::move(result), std::move(options), missing});
  return maps;
}

ResultSheet sheet_of(const Store& store, const viewshed::SitePlan& r, const SiteMap& map,
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
  sheet.title.statement = statement_of(metadata, r.request.themes, Detail::tolerance(0));
  const bool turbines = r.request.turbines.has_value();
  const std::string one = viewshed::wording_of(r.request).one;
  sheet.title.facts = {{turbines ? "Objective" : "Served", r.meaning()},
                       {turbines ? "Turbines" : "Targets", map.options.subtitle},
                       {"Choice", fmt::format("{}, {}", counted(r.choice.chosen.size(), one),
                                              turbines ? least_in_words(r) : served_in_words(r))},
                       {"Earth", r.request.earth.convention()}};
  if (r.undecided > 0) sheet.title.facts.insert(sheet.title.facts.end() - 1, {"Undecided", undecided_in_words(r)});
  sheet.title.sources = sources;
  return sheet;
}

/// Returns a sheet for each map. The sheets refer to the maps.
std::vector<ResultSheet> sheets_of(const Store& store, const viewshed::SitePlan& r, const std::vector<SiteMap>& maps,
                                   const std::vector<std::string>& sources, Progress& progress) {
  const std::vector<MapObjects> objects = site_map_objects(store, r);
  std::vector<ResultSheet> sheets;
  for (const SiteMap& map : maps) sheets.push_back(sheet_of(store, r, map, objects, sources, progress));
  return sheets;
}

}  // namespace

void write_site_maps(const Store& store, const SiteOptions& options, const viewshed::SitePlan& r, bool overwrite,
                     Progress& progress, std::vector<std::string>& warnings) {
  progress.report("maps", 0);
  const Tin tin = hillshade_surface(store, r.rasters.grid, progress);
  const std::vector<SiteMap> maps = site_maps(store, r, progress);
  parallel_for(maps.size(), [&](std::size_t i) {
    const viewshed::MapImage image = draw_map(tin, maps[i].result, maps[i].options);
    write_image(options.path(maps[i].name) + ".png", image, overwrite);
    // All maps are drawn with the same font, or without one, so that the warnings of the first one suffice.
    if (i == 0) warnings.insert(warnings.end(), image.warnings.begin(), image.warnings.end());
  });
}

std::vector<std::string> site_figures(const Store& store, const viewshed::SitePlan& r, Progress& progress) {
  WebMaps web(store, shown_area(r), progress);
  const std::vector<SiteMap> maps = site_maps(store, r, progress);
  const std::vector<ResultSheet> sheets = sheets_of(store, r, maps, {}, progress);
  std::vector<std::string> figures;
  for (std::size_t i = 0; i < maps.size(); ++i) figures.push_back(web.figure(sheets[i], maps[i].options.subtitle));
  return figures;
}

void write_site_sheets(const Store& store, const SiteOptions& options, const viewshed::SitePlan& r,
                       const std::vector<std::string>& sources, bool overwrite, Progress& progress) {
  if (!options.sheets.given()) return;
  const std::vector<SiteMap> maps = site_maps(store, r, progress);
  const std::vector<ResultSheet> sheets = sheets_of(store, r, maps, sources, progress);
  for (const profile::PaperSize paper : options.sheets.papers()) {
    const MapBase base = base_of(store, sheets.front(), paper, options.sheets, progress);
    for (std::size_t i = 0; i < maps.size(); ++i) {
      const profile::MapSheet sheet = map_sheet(store, sheets[i], base, paper, options.sheets);
      for (const std::string& name : sheet_names(maps[i].name, paper))
        write_file(options.path(name), profile::draw_map_sheet(sheet, name), overwrite);
    }
  }
}

}  // namespace itin::cli
