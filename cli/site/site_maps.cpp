#include "site/site_maps.hpp"

#include <fmt/format.h>

#include <itin/output_file.hpp>
#include <viewshed/missing_ground.hpp>
#include <viewshed/result_map.hpp>
#include <viewshed/result_sheet.hpp>
#include <viewshed/site_maps.hpp>
#include <viewshed/site_wording.hpp>

#include "output/store_document.hpp"
#include "output/web_map.hpp"
#include "site/site_map_objects.hpp"
#include "site/site_wording.hpp"

namespace itin::cli {

namespace {

viewshed::ResultSheet sheet_of(const Store& store, const viewshed::SitePlan& r, const viewshed::SiteMap& map,
                               const std::vector<viewshed::MapObjects>& objects,
                               const std::vector<std::string>& sources, Progress& progress) {
  const StoreMetadata& metadata = store.metadata();
  viewshed::ResultSheet sheet{
      map.result.grid,
      shown_area(r),
      viewshed::result_map(map.result, map.options),
      "Demand, and area within the radius",
      viewshed::in_cells(map.result.grid,
                         [&](std::size_t cell) { return map.result.visible[cell] != viewshed::Verdict::kOutside; }),
      objects,
      {}};
  sheet.missing = viewshed::missing_on_sheet(viewshed::places_without_ground(store, map.result, progress), map.missing,
                                             viewshed::kWithinRadius);
  sheet.outside = map.options.outside;
  sheet.title.title = map.options.title;
  sheet.title.statement = viewshed::statement_of(metadata, r.request.themes, Detail::tolerance(0));
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
std::vector<viewshed::ResultSheet> sheets_of(const Store& store, const viewshed::SitePlan& r,
                                             const std::vector<viewshed::SiteMap>& maps,
                                             const std::vector<std::string>& sources, Progress& progress) {
  const std::vector<viewshed::MapObjects> objects = site_map_objects(store, r);
  std::vector<viewshed::ResultSheet> sheets;
  for (const viewshed::SiteMap& map : maps) sheets.push_back(sheet_of(store, r, map, objects, sources, progress));
  return sheets;
}

}  // namespace

std::vector<std::string> site_figures(const Store& store, const viewshed::SitePlan& r, Progress& progress) {
  WebMaps web(store, shown_area(r), progress);
  const std::vector<viewshed::SiteMap> maps = viewshed::site_maps(store, r, progress);
  const std::vector<viewshed::ResultSheet> sheets = sheets_of(store, r, maps, {}, progress);
  std::vector<std::string> figures;
  for (std::size_t i = 0; i < maps.size(); ++i) figures.push_back(web.figure(sheets[i], maps[i].options.subtitle));
  return figures;
}

void write_site_sheets(const Store& store, const SiteOptions& options, const viewshed::SitePlan& r,
                       const std::vector<std::string>& sources, bool overwrite, Progress& progress) {
  if (!options.sheets.given()) return;
  const std::vector<viewshed::SiteMap> maps = viewshed::site_maps(store, r, progress);
  const std::vector<viewshed::ResultSheet> sheets = sheets_of(store, r, maps, sources, progress);
  for (const profile::PaperSize paper : options.sheets.papers()) {
    const viewshed::MapBase base = base_of(store, sheets.front(), paper, options.sheets.choice(), progress);
    for (std::size_t i = 0; i < maps.size(); ++i) {
      const profile::MapSheet sheet = map_sheet(store, sheets[i], base, paper, options.sheets.choice());
      for (const std::string& name : viewshed::sheet_names(maps[i].name, paper))
        write_file(options.path(name), profile::draw_map_sheet(sheet, name), overwrite);
    }
  }
}

}  // namespace itin::cli
