// The files of a plan: tables, layers, rasters and maps in one folder.

#include <filesystem>

#include <fmt/format.h>

#include <itin/error.hpp>
#include <itin/new_folder.hpp>
#include <itin/output_file.hpp>
#include <itin/raster.hpp>
#include <viewshed/site_maps.hpp>
#include <viewshed/site_wording.hpp>

#include "workflows/premises/output/premises_map.hpp"
#include "workflows/premises/output/premises_tables.hpp"
#include "workflows/siting/output/link_tables.hpp"
#include "workflows/siting/output/site_tables.hpp"

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

void write_rasters(const std::string& folder, const SitePlan& r, const SitePlanFileOptions& options) {
  const SiteRasters& rasters = r.rasters;
  const SiteWording wording = wording_of(r.request);
  const bool turbines = r.request.turbines.has_value();
  RasterDescription description;
  description.crs_wkt = r.crs_wkt;
  description.overwrite = options.overwrite;
  description.metadata = options.metadata;
  std::vector<std::uint8_t> served;
  for (const Verdict verdict : rasters.served) served.push_back(static_cast<std::uint8_t>(verdict));
  RasterDescription classes = description;
  classes.band_name = turbines ? "seen" : "served";
  classes.nodata = 255;
  classes.classes = {{0, turbines ? wording.unserved : "not served", {225, 225, 225}},
                     {1, turbines ? wording.served : "served", {0, 114, 178}},
                     {255, "beyond the radius, or no data", kTransparent}};
  if (r.leaves_open) classes.classes.insert(classes.classes.end() - 1, {2, "undecided", {230, 159, 0}});
  write_raster(within(folder, "coverage.tif"), rasters.grid, std::span<const std::uint8_t>(served), classes);
  description.nodata = SiteRasters::kOutside;
  description.band_name = wording.count;
  write_raster(within(folder, "redundancy.tif"), rasters.grid, std::span<const std::uint16_t>(rasters.redundancy),
               description);
  description.band_name = wording.nearest;
  for (std::size_t i = 0; i < r.choice.chosen.size(); ++i)
    description.metadata.emplace_back(fmt::format("site_{}", i + 1), r.place_of(r.choice.chosen[i]).name);
  for (std::size_t i = 0; i < r.inputs.existing(); ++i)
    description.metadata.emplace_back(fmt::format("site_{}", r.choice.chosen.size() + i + 1),
                                      "existing " + r.inputs.positions[r.inputs.options.size() + i].name);
  write_raster(within(folder, "best-server.tif"), rasters.grid, std::span<const std::uint16_t>(rasters.best_server),
               description);
}

void write_tables(const std::string& folder, const SitePlan& plan, bool overwrite) {
  write_file(within(folder, "sites.csv"), sites_csv(plan), overwrite);
  write_file(within(folder, "candidates.csv"), candidates_csv(plan), overwrite);
  if (plan.request.turbines) {
    write_file(within(folder, "turbines.csv"), turbines_csv(plan), overwrite);
  } else {
    write_file(within(folder, "links.csv"), links_csv(plan), overwrite);
    if (plan.request.hub) write_file(within(folder, "routes.csv"), routes_csv(plan), overwrite);
  }
}

void write_layers(const std::string& folder, const SitePlan& plan, bool overwrite) {
  std::vector<VectorLayer> layers{sites_layer(plan), candidates_layer(plan)};
  if (plan.request.turbines) {
    write_geopackage(within(folder, "turbines.gpkg"), plan.crs_wkt, {turbines_layer(plan)}, overwrite);
  } else {
    layers.push_back(links_layer(plan));
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
                            bool overwrite) {
  if (!plan.premises) return;
  const PremisesSurvey& survey = *plan.premises;
  write_file(within(folder, "premises.csv"), premises_csv(survey), overwrite);
  write_geopackage(within(folder, "premises.gpkg"), plan.crs_wkt, premises_layers(survey), overwrite, progress);
  write_file(within(folder, "premises.png"), premises_map(store, survey, "premises.png", progress), overwrite);
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
  files.push_back({"coverage.png", "map of coverage.tif"});
  files.push_back({"redundancy.png", "map of redundancy.tif"});
  if (request.demand.premises) {
    files.push_back(
        {"premises.csv", "a row for each building: which site serves it, where on it and from which height"});
    files.push_back({"premises.gpkg", "walls, buildings and their links to sites for a GIS, with styles for QGIS"});
    files.push_back({"premises.png", "map of walls and buildings by how they are served"});
  }
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
  write_rasters(folder, plan, options);
  write_tables(folder, plan, options.overwrite);
  write_layers(folder, plan, options.overwrite);
  write_premises_of_plan(folder, plan, store, progress, options.overwrite);
  return files;
}

}  // namespace itin::viewshed
