// The files of a plan: tables, layers, rasters and maps in one folder.

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <itin/error.hpp>
#include <itin/new_folder.hpp>
#include <itin/output_file.hpp>
#include <itin/raster.hpp>
#include <viewshed/result_raster.hpp>
#include <viewshed/site_maps.hpp>
#include <viewshed/site_wording.hpp>

#include "turbines/value_bands.hpp"
#include "workflows/premises/output/premises_map.hpp"
#include "workflows/premises/output/premises_tables.hpp"
#include "workflows/siting/output/link_tables.hpp"
#include "workflows/siting/output/point_tables.hpp"
#include "workflows/siting/output/site_tables.hpp"
#include "workflows/siting/request_rules.hpp"

namespace itin::viewshed {

namespace {

std::string within(const std::string& folder, const std::string& name) {
  return (std::filesystem::path(folder) / name).string();
}

/// Checks, before any file is written, that none is there already.
void require_free(const std::vector<PlanFile>& files) {
  for (const PlanFile& file : files)
    if (std::filesystem::exists(file.path)) throw FileError(file.path, "exists already; `overwrite` replaces it");
}

RasterDescription description_of(const SitePlan& plan, const SitePlanFileOptions& options) {
  RasterDescription description;
  description.crs_wkt = plan.crs_wkt;
  description.overwrite = options.overwrite;
  description.metadata = options.metadata;
  return description;
}

/// Writes a raster of the plan, NAME.tif, and its style for QGIS, NAME.qml.
template <class T>
void write_styled(const std::string& folder, const std::string& name, const SitePlan& plan,
                  const std::vector<T>& values, const RasterDescription& description, const std::string& style) {
  write_raster(within(folder, name + ".tif"), plan.rasters.grid, std::span<const T>(values), description);
  write_file(within(folder, name + ".qml"), style, description.overwrite);
}

void write_coverage(const std::string& folder, const SitePlan& plan, RasterDescription description) {
  const SiteWording wording = wording_of(plan.request);
  const bool turbines = plan.request.turbines.has_value();
  description.band_name = turbines ? "seen" : "served";
  description.nodata = 255;
  description.classes = {{0, turbines ? wording.unserved : "not served", {225, 225, 225}},
                         {1, turbines ? wording.served : "served", {0, 114, 178}}};
  if (plan.leaves_open) description.classes.push_back({2, "undecided", {230, 159, 0}});
  const std::string style = class_style(description.classes);
  description.classes.push_back({255, "beyond the radius, or no data", kTransparent});
  std::vector<std::uint8_t> served;
  for (const Verdict verdict : plan.rasters.served) served.push_back(static_cast<std::uint8_t>(verdict));
  write_styled(folder, "coverage", plan, served, description, style);
}

void write_redundancy(const std::string& folder, const SitePlan& plan, RasterDescription description) {
  description.nodata = SiteRasters::kOutside;
  description.band_name = wording_of(plan.request).count;
  const std::size_t sites = plan.choice.chosen.size() + plan.inputs.existing();
  write_styled(folder, "redundancy", plan, plan.rasters.redundancy, description, banded_style(count_bands(sites)));
}

void write_best_server(const std::string& folder, const SitePlan& plan, RasterDescription description) {
  description.nodata = SiteRasters::kOutside;
  description.band_name = plan.levels ? "server of the greatest level; 0 none" : wording_of(plan.request).nearest;
  std::vector<StyleClass> style{{0, kNoneSeen, kTransparent}};
  for (const std::string& name : plan.rasters.servers) {
    const std::size_t number = style.size();
    description.metadata.emplace_back(fmt::format("site_{}", number), name);
    style.push_back({static_cast<std::int64_t>(number), name, distinct_colour(number - 1)});
  }
  write_styled(folder, "best-server", plan, plan.rasters.best_server, description, class_style(style));
}

void write_rasters(const std::string& folder, const SitePlan& plan, const Store& store,
                   const SitePlanFileOptions& options, const Progress& progress) {
  const RasterDescription description = description_of(plan, options);
  write_coverage(folder, plan, description);
  write_redundancy(folder, plan, description);
  write_best_server(folder, plan, description);
  if (plan.levels)
    write_result_raster(within(folder, "level.tif"), *plan.levels, store.metadata(), {.overwrite = options.overwrite},
                        progress);
}

void write_tables(const std::string& folder, const SitePlan& plan, bool overwrite) {
  write_file(within(folder, "sites.csv"), sites_csv(plan), overwrite);
  write_file(within(folder, "candidates.csv"), candidates_csv(plan), overwrite);
  if (plan.request.turbines) {
    write_file(within(folder, "turbines.csv"), turbines_csv(plan), overwrite);
  } else {
    write_file(within(folder, "links.csv"), links_csv(plan), overwrite);
    if (plan.request.hub) write_file(within(folder, "routes.csv"), routes_csv(plan), overwrite);
    if (tells_points(plan.request)) write_file(within(folder, "demand.csv"), points_csv(plan), overwrite);
  }
}

void write_layers(const std::string& folder, const SitePlan& plan, bool overwrite) {
  std::vector<VectorLayer> layers{sites_layer(plan), candidates_layer(plan)};
  if (plan.request.turbines) {
    write_geopackage(within(folder, "turbines.gpkg"), plan.crs_wkt, {turbines_layer(plan)}, overwrite);
  } else {
    layers.push_back(links_layer(plan));
    if (tells_points(plan.request)) layers.push_back(points_layer(plan));
  }
  write_geopackage(within(folder, "sites.gpkg"), plan.crs_wkt, layers, overwrite);
}

void write_maps(const std::string& folder, const SitePlan& plan, const Store& store, Progress& progress,
                bool overwrite) {
  const std::vector<SiteMap> maps = site_maps(store, plan, progress);
  const std::vector<MapImage> images = drawn(store, plan, maps, progress);
  for (std::size_t i = 0; i < maps.size(); ++i)
    write_image(within(folder, maps[i].name + ".png"), images[i], overwrite);
}

/// Writes which site serves which building, in the words and colours of a survey of premises.
void write_premises_of_plan(const std::string& folder, const SitePlan& plan, const Store& store, Progress& progress,
                            const SitePlanFileOptions& options) {
  if (!plan.premises) return;
  const PremisesSurvey& survey = *plan.premises;
  write_file(within(folder, "premises.csv"), premises_csv(survey), options.overwrite);
  write_geopackage(within(folder, "premises.gpkg"), plan.crs_wkt, premises_layers(survey), options.overwrite, progress);
  write_file(within(folder, "premises.png"), premises_map(store, survey, options.sheets, "premises.png", progress),
             options.overwrite);
}

}  // namespace

std::vector<PlanFile> site_plan_files(const std::string& folder, const SitePlanRequest& request) {
  std::vector<PlanFile> files;
  if (request.turbines) {
    files = {{"turbines.csv", "the turbines, as itin ztv `turbines` reads them"},
             {"turbines.gpkg", "the same for a GIS"},
             {"sites.gpkg", "turbines and candidates"},
             {"sites.csv", "turbines in order, with what each adds"},
             {"candidates.csv", "every candidate, its bounds and why it is chosen or not"},
             {"coverage.tif", "what sees the turbines, existing ones too"},
             {"redundancy.tif", "how many of them a cell sees"},
             {"best-server.tif", "the nearest of them that a cell sees"}};
  } else {
    files = {{"sites.gpkg", "chosen sites, candidates, links between sites"},
             {"sites.csv", "chosen sites in order, with gains and bounds"},
             {"candidates.csv", "every candidate, its bounds and why it is chosen or not"},
             {"links.csv", "lines of sight between chosen sites"},
             {"coverage.tif", "what the choice and existing sites serve"},
             {"redundancy.tif", "how many of them serve a cell"},
             {"best-server.tif", "the nearest site that serves a cell"}};
  }
  if (request.by_level()) {
    files.back().what = "the site or sector of the greatest level, of those that serve a cell";
    files.push_back(
        {"level.tif", "the greatest level that a site gives a cell, its margin, and which server it is of"});
  }
  std::vector<std::string> styled = site_map_names(request);
  styled.insert(styled.begin() + 2, "best-server");
  for (const std::string& raster : styled)
    files.push_back({raster + ".qml", fmt::format("style of {}.tif for QGIS", raster)});
  for (const std::string& map : site_map_names(request))
    files.push_back({map + ".png", fmt::format("map of {}.tif", map)});
  if (request.demand.premises) {
    files.push_back(
        {"premises.csv", "a row for each building: which site serves it, where on it and from which height"});
    files.push_back({"premises.gpkg", "walls, buildings and their links to sites for a GIS, with styles for QGIS"});
    files.push_back({"premises.png", "map of walls and buildings by how they are served"});
  }
  if (tells_points(request))
    files.push_back(
        {"demand.csv", "a row for each point of the demand: how it is served, by which site, and its line"});
  if (request.hub) files.push_back({"routes.csv", "the route of every site to the hub, hop by hop"});
  for (PlanFile& file : files) file.path = within(folder, file.path);
  return files;
}

std::vector<PlanFile> write_site_plan(const std::string& folder, const SitePlan& plan, const Store& store,
                                      Progress& progress, const SitePlanFileOptions& options) {
  const NewFolder made(folder);
  std::vector<PlanFile> files = site_plan_files(folder, plan.request);
  if (!options.overwrite) require_free(files);
  write_maps(folder, plan, store, progress, options.overwrite);
  write_rasters(folder, plan, store, options, progress);
  write_tables(folder, plan, options.overwrite);
  write_layers(folder, plan, options.overwrite);
  write_premises_of_plan(folder, plan, store, progress, options);
  return files;
}

}  // namespace itin::viewshed
