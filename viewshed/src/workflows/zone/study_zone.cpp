// A study from its request to its result.
#include <algorithm>

#include <fmt/format.h>

#include <itin/error.hpp>
#include <itin/sources_in.hpp>
#include <itin/store_scale.hpp>
#include <viewshed/missing_ground.hpp>
#include <viewshed/zone_study.hpp>
#include <viewshed/zone_study_tasks.hpp>

#include "workflows/zone/route_study.hpp"
#include "workflows/zone/study_document.hpp"
#include "workflows/zone/study_radio.hpp"
#include "workflows/zone/viewpoint_study.hpp"

namespace itin::viewshed {

namespace {

/// The box that all sight lines from cells to turbines and from the radar lie in.
Box looked_at(const Zone& zone) {
  Box box = zone.grid.bounds();
  for (const Turbine& turbine : zone.request.turbines) box.extend(turbine.position);
  if (zone.request.radar) box.extend(zone.request.radar->position);
  return box;
}

/// Completes what follows from other parts of the request.
void complete(ZoneStudyRequest& request, const StoreMetadata& metadata) {
  TurbineTable& table = request.turbines;
  request.zone.turbines = table.turbines;
  for (const Turbine& turbine : table.turbines) table.rows = std::max(table.rows, turbine.number);
  for (const Viewpoint& v : request.viewpoints.viewpoints)
    request.viewpoints.rows = std::max(request.viewpoints.rows, v.number);
  if (!request.zone.themes) return;
  request.zone.themes->check(metadata.themes);
  if (!request.zone.themes->includes_raised(metadata.themes)) request.zone.themes.reset();
}

void require_reasonable(const ZoneStudyRequest& request) {
  require_links(request);
  if (!(request.route_step > 0)) throw InputError("`route_step`: give a distance greater than 0", "route_step");
}

/// Names turbines without ground among the rows that are not used.
void add_misplaced(const Zone& zone, TurbineTable& table) {
  for (const Misplaced& m : zone.misplaced) table.bad.push_back(bad_row(table, m.number, m.message));
}

void require_any_cell(const ZoneStudy& study) {
  if (study.missing.study_m2() > 0) return;
  const std::string& source = study.request.grid_source;
  throw InputError(
      fmt::format(
          "{}: none of the cells lies within the radius of a turbine; move them there, or give a larger `radius`",
          study.zone.request.cell_size ? "`cell_size`"
          : source.empty()             ? "`grid`"
                                       : source),
      study.zone.request.cell_size ? "cell_size" : "grid");
}

std::vector<std::string> warnings_of(const ZoneStudy& study) {
  const auto& [turbines, request, grid_source, viewpoints, routes, step, links, frequency] = study.request;
  std::vector<std::string> warnings = study.zone.warnings;
  const auto add = [&](const std::vector<std::string>& more) {
    warnings.insert(warnings.end(), more.begin(), more.end());
  };
  if (const auto warning = study.missing.warning("the study area, all turbines' radii,")) warnings.push_back(*warning);
  for (const BadRow& bad : turbines.bad) warnings.push_back(bad_row_warning(turbines.path, bad));
  add(turbines.warnings);
  warn_of_radio(study, warnings);
  for (const BadRow& bad : viewpoints.bad) warnings.push_back(bad_row_warning(viewpoints.path, bad));
  add(viewpoints.warnings);
  add(routes.warnings);
  warn_of_grid(study.metadata, warnings);
  return warnings;
}

}  // namespace

ZoneStudy study_zone(const Store& store, ZoneStudyRequest request, Progress& progress) {
  return study_zone_by([&](const ZoneRequest& zone) { return survey_turbines(store, zone, progress); }, store,
                       std::move(request), progress);
}

std::unique_ptr<ZoneTasks> tasks_of_study(const Store& store, ZoneStudyRequest request, std::uint64_t most_cells,
                                          Progress& progress) {
  require_reasonable(request);
  complete(request, store.metadata());
  return std::make_unique<ZoneTasks>(store, request.zone, most_cells, progress);
}

ZoneStudy study_zone_by(const SurveyZone& survey, const Store& store, ZoneStudyRequest request, Progress& progress) {
  ZoneStudy study;
  study.metadata = store.metadata();
  require_reasonable(request);
  complete(request, study.metadata);
  study.zone = survey(request.zone);
  study.request = std::move(request);
  const ZoneRequest& surveyed = study.zone.request;
  add_misplaced(study.zone, study.request.turbines);
  study.sources = sources_in(store, looked_at(study.zone), surveyed.themes.value_or(ThemeChoice::none()));
  study.missing = missing_ground(study.zone);
  require_any_cell(study);
  study.link_clearances = link_clearances(study.request, study.zone);
  const StudySurfaces surfaces(store, surveyed);
  study.viewpoints = study_viewpoints(surfaces, study.zone, study.metadata, study.request.viewpoints, progress);
  study.routes = study_routes(surfaces, study.request, study.zone, progress);
  study.warnings = warnings_of(study);
  return study;
}

}  // namespace itin::viewshed
