// The folder of a survey of premises.

#include <utility>

#include <itin/call_progress.hpp>
#include <itin/mesh_export.hpp>
#include <itin/output_file.hpp>
#include <viewshed/premises.hpp>
#include <viewshed/premises_document.hpp>

#include "workflows/premises/output/facade_meshes.hpp"
#include "workflows/premises/output/premises_map.hpp"
#include "workflows/premises/output/premises_tables.hpp"
#include "workflows/zone/output/study_folder.hpp"

namespace itin::viewshed {

namespace {

/// The file that tells a folder of such outputs from any other.
constexpr const char* kPremisesManifest = "premises.json";

std::vector<PlanFile> premises_files(const std::string& folder, const PremisesRequest& request) {
  std::vector<PlanFile> files{
      {"premises.csv",
       "a row for each building: which mast serves it, where on it and from which height, or what is in "
       "the way"},
      {"links.csv", "a row for each building and mast within reach"},
      {"premises.gpkg", "walls, buildings, links and masts for a GIS, with styles for QGIS"},
      {"premises.png", "map of walls and buildings by how they are served"},
      {"facades.glb", "walls in 3D, in the colours of the map, a part for each mast that serves them"}};
  if (request.setback)
    files.push_back({"roofs.csv",
                     "a row for each place on a roof: the mast that serves it with the least pole, and the least pole "
                     "that sees the street"});
  return files_within(folder, std::move(files));
}

}  // namespace

void require_premises_folder(const std::string& path, bool overwrite) {
  require_study_folder(path, kPremisesManifest, overwrite);
}

std::vector<PlanFile> write_premises(const std::string& folder, const Store& store, const PremisesSurvey& survey,
                                     const PremisesFileOptions& options, Progress& progress) {
  StudyFolder target(folder, kPremisesManifest, options.overwrite);
  const auto path = [&](const char* name) { return target.working() + "/" + name; };
  CallProgress call(progress);
  call.step(0.2).report("tables", 0);
  write_file(path("premises.csv"), premises_csv(survey), true);
  write_file(path("links.csv"), premises_links_csv(survey), true);
  if (survey.request.setback) write_file(path("roofs.csv"), premises_roofs_csv(survey), true);
  call.step(0.3).report("layers", 0);
  write_geopackage(path("premises.gpkg"), survey.metadata.crs_wkt, premises_layers(survey), true, call);
  write_meshes(path("facades.glb"), survey.metadata.crs_wkt, facade_meshes(survey), true, call.step(0.1));
  write_file(path("premises.png"), premises_map(store, survey, options.sheets, "premises.png", call.step(1)), true);
  std::vector<PlanFile> files = premises_files(folder, survey.request);
  write_file(path(kPremisesManifest),
             options.manifest ? options.manifest(files) : manifest_text(premises_document(survey), files), true);
  target.publish();
  call.finish();
  return files;
}

}  // namespace itin::viewshed
