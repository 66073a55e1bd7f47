// The folder of a survey of dwellings.

#include <utility>

#include <itin/call_progress.hpp>
#include <itin/output_file.hpp>
#include <viewshed/dwellings.hpp>
#include <viewshed/dwellings_document.hpp>

#include "workflows/dwellings/flicker_clock.hpp"
#include "workflows/dwellings/output/dwelling_calendar.hpp"
#include "workflows/dwellings/output/dwelling_layers.hpp"
#include "workflows/dwellings/output/dwelling_map.hpp"
#include "workflows/dwellings/output/dwelling_sheets.hpp"
#include "workflows/dwellings/output/dwelling_tables.hpp"
#include "workflows/zone/output/study_folder.hpp"

namespace itin::viewshed {

namespace {

/// The file that tells a folder of such outputs from any other.
constexpr const char* kDwellingsManifest = "dwellings.json";

std::vector<PlanFile> dwellings_files(const DwellingsRequest& request) {
  const std::string clock = clock_name(request.flicker.year);
  std::vector<PlanFile> files{
      {"dwellings.csv",
       "a row for each dwelling: its nearest turbine, its shadow flicker in the worst case, and what its facades see "
       "of the turbines together"},
      {"facades.csv",
       "a row for each facade: the hubs and tips that are seen from before it, and the arcs that they take"},
      {"flicker.csv", "a row for each dwelling and turbine whose shadow flickers there"},
      {"dwellings.gpkg", "dwellings, facades and turbines for a GIS, with styles for QGIS"},
      {"dwellings.png", "map of the dwellings by their shadow flicker"},
      {"calendar.csv",
       "when it flickers: a row for each dwelling, turbine, day and stretch of minutes; times are " + clock},
      {"calendar.png", "when each turbine's shadow flickers at any of the dwellings: days across, hours up"}};
  return files;
}

}  // namespace

void require_dwellings_folder(const std::string& path, bool overwrite) {
  require_study_folder(path, kDwellingsManifest, overwrite);
}

std::vector<PlanFile> write_dwellings(const std::string& folder, const Store& store, const DwellingsSurvey& survey,
                                      const DwellingsFileOptions& options, Progress& progress) {
  dwellings_of_sheets(survey, options.sheets_of);
  StudyFolder target(folder, kDwellingsManifest, options.overwrite);
  const auto path = [&](const char* name) { return target.working() + "/" + name; };
  CallProgress call(progress);
  call.step(0.2).report("tables", 0);
  write_file(path("dwellings.csv"), dwellings_csv(survey), true);
  write_file(path("facades.csv"), facades_csv(survey), true);
  write_file(path("flicker.csv"), flicker_csv(survey), true);
  call.throw_if_cancelled();
  write_file(path("calendar.csv"), calendar_csv(survey), true);
  call.step(0.2).report("layers", 0);
  write_geopackage(path("dwellings.gpkg"), survey.metadata.crs_wkt, dwelling_layers(survey), true, call);
  const CalendarMaker calendars(survey, call);
  write_file(path("calendar.png"), profile::draw_flicker_calendar(calendars.of_all(), "calendar.png"), true);
  const double share_of_sheets = options.sheets.papers.empty() ? 0 : 0.7;
  write_file(path("dwellings.png"),
             dwelling_map(store, survey, options.sheets, "dwellings.png", call.step(1 - share_of_sheets)), true);
  const std::vector<PlanFile> sheets =
      write_dwelling_sheets(target.working(), store, survey, calendars, options, call.step(1));
  std::vector<PlanFile> files = dwellings_files(survey.request);
  files.insert(files.end(), sheets.begin(), sheets.end());
  files = files_within(folder, std::move(files));
  write_file(path(kDwellingsManifest),
             options.manifest ? options.manifest(files) : manifest_text(dwellings_document(survey), files), true);
  target.publish();
  call.finish();
  return files;
}

}  // namespace itin::viewshed
