// The folder of a study.
#include <algorithm>
#include <filesystem>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <itin/error.hpp>
#include <itin/output_file.hpp>
#include <itin/surface_text.hpp>
#include <viewshed/radius_document.hpp>
#include <viewshed/zone_files.hpp>
#include <viewshed/zone_study_document.hpp>

#include "workflows/zone/output/route_files.hpp"
#include "workflows/zone/output/study_folder.hpp"
#include "workflows/zone/output/study_layers.hpp"
#include "workflows/zone/output/study_lines.hpp"
#include "workflows/zone/output/study_methods.hpp"
#include "workflows/zone/output/study_sheets.hpp"
#include "workflows/zone/output/viewpoint_tables.hpp"
#include "workflows/zone/output/wireline_files.hpp"
#include "workflows/zone/study_document.hpp"
#include "workflows/zone/study_radio.hpp"
#include "workflows/zone/turbine_rows.hpp"

namespace itin::viewshed {

namespace {

void require_farm_known(const Zone& zone, const std::string& farm) {
  const std::vector<std::string> farms = farms_of(zone.request.turbines);
  if (!farm.empty() && std::find(farms.begin(), farms.end(), farm) == farms.end())
    throw InputError(fmt::format("`alone`: unknown wind farm '{}'; known: {}", farm, fmt::join(farms, ", ")), "alone");
}

void require_viewpoint_known(const ZoneStudy& study, const std::string& name) {
  const bool known = std::any_of(study.viewpoints.begin(), study.viewpoints.end(),
                                 [&](const StudiedViewpoint& v) { return is_called(v.viewpoint, name); });
  if (!known)
    throw InputError(
        fmt::format("`wirelines`: '{}' is no viewpoint of {} that can be used", name, study.request.viewpoints.path),
        "wirelines");
}

/// Writes the files of a study into a folder, one kind after the other.
class StudyWriter {
 public:
  StudyWriter(std::string folder, const Store& store, const ZoneStudy& study, const ZoneStudyFileOptions& options,
              Progress& progress)
      : folder_(std::move(folder)), store_(store), study_(study), options_(options), progress_(progress) {}

  std::vector<ZoneFile> write() && {
    write_maps();
    if (has_viewpoints(study_.request)) write_viewpoints();
    if (!study_.routes.empty()) add(write_routes(folder_, study_));
    if (!options_.sheets.papers.empty())
      add(write_study_sheets(folder_, store_, study_, lines_, options_.sheets, progress_));
    write_tables();
    return std::move(files_);
  }

 private:
  void add(const std::vector<ZoneFile>& more) { files_.insert(files_.end(), more.begin(), more.end()); }
  void add(const std::string& name, const std::string& what, const std::string& bytes) {
    write_file(folder_ + "/" + name, bytes, true);
    files_.push_back({name, what});
  }

  void write_maps() {
    const ZoneRequest& request = study_.zone.request;
    ZoneFileOptions options;
    options.crs_wkt = study_.metadata.crs_wkt;
    options.metadata = {{"itin", ITIN_VERSION},
                        {"observer_height_m", fmt::format("{:g}", request.observer_height)},
                        {"refraction", request.earth.convention()},
                        {"surface", json_text(study_surface(study_))}};
    progress_.report("rasters", 0);
    add(write_zone_rasters(folder_, study_.zone, options));
    add(write_radio_rasters(folder_, study_, options));
    progress_.report("polygons", 0);
    add(write_zone_polygons(folder_, study_.zone, options));
  }

  void write_viewpoints() {
    require_farm_known(study_.zone, options_.wirelines.alone);
    for (const std::string& name : options_.wirelines.viewpoints) require_viewpoint_known(study_, name);
    add("viewpoints.csv", "viewpoint by turbine: hub and tip visible, metres and degrees seen, azimuth",
        viewpoint_table(study_));
    add("viewpoints-summary.csv",
        "a row for each viewpoint: hubs and tips visible, the nearest turbine, the part of the horizon that "
        "the visible ones take up",
        viewpoint_summary(study_));
    if (!options_.wirelines.none)
      add(write_wirelines(folder_, store_, study_, options_.wirelines, options_.sheets, progress_));
  }

  void write_tables() {
    const Zone& zone = study_.zone;
    add("areas.csv", "km² by band of turbines visible and by ring of distance to the nearest turbine",
        area_table(zone));
    add("area-totals.csv", "km² by band of turbines visible and by combination of farms, over the whole study area",
        area_totals(zone));
    if (farms_of(zone.request.turbines).size() > 1)
      add("farms.csv", "what the values of farms.tif stand for: combinations of farms, and km² of each",
          combination_table(zone));
    add("turbines.csv", "the turbines row by row: heights and ground as used, and why a row is not used",
        turbine_rows(study_));
    if (const std::optional<RadiusRule>& rule = study_.request.turbines.radius)
      add("radius-preset.json", "the radii used, to edit and give by `radius_rule`",
          json_text(radius_document(*rule), 2) + "\n");
    write_geopackage(folder_ + "/layers.gpkg", study_.metadata.crs_wkt, study_layers(study_, lines_), true, progress_,
                     season_layers(zone));
    files_.push_back(
        {"layers.gpkg", "turbines, viewpoints, routes, radio links and what they exclude, rings and study area" +
                            std::string(zone.seasons ? ", and what is seen in summer and in winter," : "") +
                            " as layers for a GIS, with styles for QGIS"});
    add("methods.md", "how the results were computed, for a chapter on methods", methods_text(study_, options_));
  }

  std::string folder_;
  const Store& store_;
  const ZoneStudy& study_;
  const StudyLines lines_ = study_lines(study_);
  const ZoneStudyFileOptions& options_;
  Progress& progress_;
  std::vector<ZoneFile> files_;
};

/// Returns the document of the folder, without times, so that equal runs write equal files.
std::string manifest_of(const ZoneStudy& study, const std::string& folder, const std::vector<ZoneFile>& files,
                        const ZoneStudyFileOptions& options) {
  if (options.manifest) return options.manifest(files);
  Document document{{"itin", ITIN_VERSION}};
  document.update(zone_study_document(study, options.decides_missing_ground));
  document["outputs"] = outputs_document(folder, files);
  document["warnings"] = study.warnings;
  document.erase("statistics");
  return json_text(document, 2) + "\n";
}

}  // namespace

Document outputs_document(const std::string& folder, const std::vector<ZoneFile>& files) {
  Document outputs = Document::array();
  for (const ZoneFile& file : files)
    outputs.push_back({{"path", (std::filesystem::path(folder) / file.name).string()}, {"what", file.what}});
  return outputs;
}

std::vector<ZoneFile> write_zone_study(const std::string& folder, const Store& store, const ZoneStudy& study,
                                       const ZoneStudyFileOptions& options, Progress& progress) {
  StudyFolder target(folder, kZoneManifest, options.overwrite);
  std::vector<ZoneFile> files = StudyWriter(target.working(), store, study, options, progress).write();
  write_file(target.working() + "/" + kZoneManifest, manifest_of(study, folder, files, options), true);
  target.publish();
  return files;
}

}  // namespace itin::viewshed
