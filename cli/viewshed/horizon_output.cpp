#include "viewshed/horizon_output.hpp"

#include <algorithm>
#include <filesystem>
#include <limits>

#include <fmt/format.h>

#include <itin/error.hpp>
#include <itin/file_ending.hpp>
#include <itin/output_file.hpp>
#include <itin/site_list.hpp>
#include <profile/chart.hpp>
#include <viewshed/documents.hpp>

#include "options/places/off_the_data.hpp"
#include "output/output_path.hpp"
#include "program/call_files.hpp"
#include "program/help.hpp"
#include "program/values.hpp"

namespace itin::cli {

namespace {

profile::Panorama panorama(const viewshed::Horizon& horizon, const viewshed::Request& request) {
  const viewshed::Observer& observer = request.observers.front();
  profile::Panorama drawing;
  drawing.title = fmt::format("Horizon of {:.10g}, {:.10g}", observer.position.x, observer.position.y);
  drawing.note =
      fmt::format("Eye at {:.1f} m; azimuths from grid north; {}", horizon.eye_elevation_m, request.earth.convention());
  for (const viewshed::HorizonPoint& p : horizon.points)
    drawing.skyline.push_back({p.azimuth_deg, p.sky ? p.sky->elevation_deg : std::numeric_limits<double>::quiet_NaN(),
                               p.sky ? p.sky->distance_m : 0, p.sky && p.sky->data_edge});
  for (const viewshed::SightedTarget& t : horizon.targets) {
    const bool undecided = t.verdict == viewshed::Verdict::kUndecided;
    drawing.places.push_back({t.target.name + (undecided ? " (undecided)" : ""), t.azimuth_deg, t.elevation_deg,
                              t.distance_m, t.verdict == viewshed::Verdict::kVisible});
  }
  return drawing;
}

}  // namespace

void HorizonOutput::declare(CLI::App& app) {
  begin_group(app, "Sky line");
  writes(app.add_option(
                "--horizon", paths_,
                "Write the observer's sky line: azimuth, elevation and distance (.csv, .json), or drawn as a panorama "
                "(.svg, .png, .pdf); may be given again")
             ->type_name("FILE")
             ->expected(1)
             ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll));
  app.add_option("--horizon-step", step_text_, "Between the sky line's azimuths (default: 0.1)")->type_name("DEGREES");
  reads(app.add_option("--horizon-targets", sites_.path, "Places to mark on the horizon, in line of sight or not")
            ->type_name("FILE"));
  app.add_option("--horizon-name-field", sites_.name_field, "The field of that file that holds names (default: name)")
      ->type_name("FIELD");
  app.add_option(
         "--horizon-height-field", sites_.height_field,
         "The field of that file that holds h (default: height, unless --target-height is given; places without one "
         "have --target-height)")
      ->type_name("FIELD");
}

void HorizonOutput::validate() {
  for (const std::string& path : paths_) {
    const std::string ending = ending_of(path);
    if (ending == ".csv" || ending == ".json") continue;
    if (ending != ".svg" && ending != ".png" && ending != ".pdf")
      throw InputError(fmt::format("--horizon '{}': a horizon is written as .csv, .json, .svg, .png or .pdf", path));
  }
  if (!step_text_.empty()) {
    step_deg_ = parse_number("--horizon-step", step_text_, Range::kPositive);
    parsed_by("--horizon-step", step_text_, [&](const std::string&) { viewshed::require_whole_turn(step_deg_); });
  }
  if (paths_.empty() && !(sites_.path + step_text_).empty())
    throw InputError("--horizon-targets and --horizon-step work only with --horizon FILE");
  if (sites_.path.empty() && !(sites_.name_field + sites_.height_field).empty())
    throw InputError("--horizon-name-field and --horizon-height-field work only with --horizon-targets");
}

void HorizonOutput::read_targets(const viewshed::Request& request, const ViewshedTargets& targets, const InCrs& in_crs,
                                 const StoreMetadata& metadata, std::vector<std::string>& warnings) {
  if (sites_.path.empty()) return;
  const LayerFields fields(sites_);
  take_heights(sites_, fields, {targets.height_given() ? "--target-height" : "", "--horizon-height-field"}, warnings);
  take_names(sites_, fields);
  sites_.crs = in_crs.crs;
  for (const Site& site : read_sites(sites_, metadata.crs_wkt, warnings)) {
    const std::string where = fmt::format("{}: {}", sites_.path, site.place);
    require_on_the_data(where, site.position, in_crs, metadata);
    const bool absolute = site.height ? targets.absolute() : request.target_absolute;
    if (!absolute && site.height.value_or(0) < 0)
      throw InputError(
          fmt::format("{}: field '{}' holds {:.10g}: a height must not be negative; for an elevation give "
                      "--absolute-heights",
                      where, sites_.height_field, *site.height));
    targets_.push_back({site.name, site.position, site.height.value_or(request.target_height), where, absolute});
  }
  if (targets_.empty()) throw InputError(none_in(sites_, "place"));
}

Document HorizonOutput::parameters() const {
  Document parameters = Document::object();
  if (!sites_.path.empty()) parameters["horizon_targets"] = sites_.path;
  if (!sites_.name_field.empty()) parameters["horizon_name_field"] = sites_.name_field;
  if (!sites_.height_field.empty()) parameters["horizon_height_field"] = sites_.height_field;
  return parameters;
}

Document HorizonOutput::write(const Store& store, viewshed::ViewshedWithSurface& computed,
                              const viewshed::Request& request, const viewshed::ComputeOptions& options, bool overwrite,
                              Progress& progress, std::vector<std::string>& warnings) const {
  if (paths_.empty()) return nullptr;
  const StoreMetadata& metadata = store.metadata();
  const viewshed::Horizon horizon =
      viewshed::horizon(store, computed, request, {step_deg_, targets_}, options, progress);
  for (const std::string& path : paths_) {
    const std::string ending = ending_of(path);
    const std::string bytes = ending == ".csv"    ? viewshed::horizon_csv(horizon, metadata)
                              : ending == ".json" ? viewshed::json_of(horizon, request, metadata)
                                                  : profile::draw_panorama(panorama(horizon, request), path);
    write_file(path, bytes, overwrite);
  }
  const auto ends = std::count_if(horizon.points.begin(), horizon.points.end(),
                                  [](const viewshed::HorizonPoint& p) { return p.sky && p.sky->data_edge; });
  if (ends > 0)
    warnings.push_back(
        fmt::format("the sky line is the edge of the data in {} of {} directions; what lies behind may rise higher",
                    ends, horizon.points.size()));
  const auto over = std::count_if(horizon.points.begin(), horizon.points.end(),
                                  [](const viewshed::HorizonPoint& p) { return p.over_missing; });
  if (over > 0)
    warnings.push_back(fmt::format("ground is missing before the sky line in {} of {} directions, and may rise higher",
                                   over, horizon.points.size()));
  return viewshed::targets_document(horizon);
}

}  // namespace itin::cli
