// The folder of a survey of dwellings.

#include <filesystem>

#include <itin/output_file.hpp>
#include <viewshed/dwellings.hpp>
#include <viewshed/dwellings_document.hpp>

#include "workflows/dwellings/flicker_clock.hpp"
#include "workflows/dwellings/output/dwelling_tables.hpp"
#include "workflows/zone/study_folder.hpp"

namespace itin::viewshed {

namespace {

/// The file that tells a folder of such outputs from any other.
constexpr const char* kDwellingsManifest = "dwellings.json";

std::vector<PlanFile> dwellings_files(const std::string& folder, const DwellingsRequest& request) {
  const std::string clock = clock_name(request.flicker.year);
  std::vector<PlanFile> files{
      {"dwellings.csv", "a row for each dwelling: its nearest turbine, and its shadow flicker in the worst case"},
      {"flicker.csv", "a row for each dwelling and turbine whose shadow flickers there"},
      {"calendar.csv",
       "when it flickers: a row for each dwelling, turbine, day and stretch of minutes; times are " + clock}};
  for (PlanFile& file : files) file.path = (std::filesystem::path(folder) / file.path).string();
  return files;
}

/// The document of the folder, without times, so that equal runs write equal files.
std::string manifest_of_dwellings(const DwellingsSurvey& survey, const std::vector<PlanFile>& files) {
  Document document = dwellings_document(survey);
  document.erase("statistics");
  for (const PlanFile& file : files) document["outputs"].push_back({{"path", file.path}, {"what", file.what}});
  return json_text(document, 2) + "\n";
}

}  // namespace

void require_dwellings_folder(const std::string& path, bool overwrite) {
  require_study_folder(path, kDwellingsManifest, overwrite);
}

std::vector<PlanFile> write_dwellings(const std::string& folder, const Store&, const DwellingsSurvey& survey,
                                      const DwellingsFileOptions& options, Progress& progress) {
  StudyFolder target(folder, kDwellingsManifest, options.overwrite);
  const auto path = [&](const char* name) { return target.working() + "/" + name; };
  progress.report("tables", 0);
  write_file(path("dwellings.csv"), dwellings_csv(survey), true);
  write_file(path("flicker.csv"), flicker_csv(survey), true);
  progress.throw_if_cancelled();
  write_file(path("calendar.csv"), calendar_csv(survey), true);
  std::vector<PlanFile> files = dwellings_files(folder, survey.request);
  write_file(path(kDwellingsManifest),
             options.manifest ? options.manifest(files) : manifest_of_dwellings(survey, files), true);
  target.publish();
  progress.report("tables", 1);
  return files;
}

}  // namespace itin::viewshed
