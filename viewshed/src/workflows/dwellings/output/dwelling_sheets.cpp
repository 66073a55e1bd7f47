#include "workflows/dwellings/output/dwelling_sheets.hpp"

#include <set>

#include <fmt/format.h>

#include <itin/call_progress.hpp>
#include <itin/error.hpp>
#include <itin/file_name.hpp>
#include <itin/output_file.hpp>
#include <viewshed/result_sheet.hpp>

#include "workflows/dwellings/output/dwelling_names.hpp"
#include "workflows/dwellings/output/dwelling_sheet.hpp"

namespace itin::viewshed {

namespace {

/// Returns the dwellings of a name or id; without any, the one in that row of dwellings.csv.
std::vector<std::size_t> dwellings_called(const DwellingsSurvey& survey, const std::string& name) {
  std::vector<std::size_t> called, in_row;
  for (std::size_t i = 0; i < survey.dwellings.size(); ++i) {
    const Dwelling& dwelling = survey.dwellings[i];
    if (dwelling.name == name || dwelling.id == name) called.push_back(i);
    if (fmt::format("{}", i + 1) == name) in_row.push_back(i);
  }
  if (called.empty()) called = in_row;
  if (called.empty())
    throw InputError(fmt::format("`sheets_of`: no dwelling of {} has the name or id '{}', nor is it a row of "
                                 "dwellings.csv",
                                 survey.dwellings.size(), name),
                     "sheets_of");
  return called;
}

}  // namespace

std::vector<std::size_t> dwellings_of_sheets(const DwellingsSurvey& survey, const std::vector<std::string>& names) {
  std::set<std::size_t> wanted;
  for (const std::string& name : names)
    for (const std::size_t i : dwellings_called(survey, name)) wanted.insert(i);
  if (names.empty())
    for (std::size_t i = 0; i < survey.dwellings.size(); ++i) wanted.insert(i);
  return {wanted.begin(), wanted.end()};
}

std::vector<PlanFile> write_dwelling_sheets(const std::string& folder, const Store& store,
                                            const DwellingsSurvey& survey, const CalendarMaker& calendars,
                                            const DwellingsFileOptions& options, Progress& progress) {
  std::vector<PlanFile> files;
  const SheetOfSurvey of{store, survey, calendars, options.sheets};
  const std::vector<std::size_t> wanted = dwellings_of_sheets(survey, options.sheets_of);
  CallProgress call(progress);
  std::size_t left = wanted.size() * options.sheets.papers.size();
  for (const std::size_t dwelling : wanted) {
    const std::string& name = name_of_dwelling(survey.dwellings[dwelling]);
    const std::string map = file_name(fmt::format("{}{}{}", dwelling + 1, name.empty() ? "" : "-", name));
    for (const profile::PaperSize paper : options.sheets.papers) {
      const profile::DwellingSheet sheet =
          dwelling_sheet(of, dwelling, paper, call.step(1.0 / static_cast<double>(left--)));
      for (const std::string& file : sheet_names(map, paper)) {
        call.throw_if_cancelled();
        write_file(fmt::format("{}/{}", folder, file), profile::draw_dwelling_sheet(sheet, file), true);
        files.push_back({file, fmt::format("sheet on {}: {}", profile::name_of(paper), sheet.title)});
      }
    }
  }
  call.finish();
  return files;
}

}  // namespace itin::viewshed
