#include "options/sheet_options.hpp"

#include <sstream>
#include <utility>

#include <fmt/format.h>

#include <itin/error.hpp>
#include <profile/map_sheet.hpp>

#include "options/day_of_run.hpp"
#include "program/call_files.hpp"
#include "program/help.hpp"
#include "program/values.hpp"

namespace itin::cli {

void SheetOptions::declare(CLI::App& app, const std::string& what) {
  begin_group(app, kMapsOnPaper);
  papers_option_ = "--sheets";
  app.add_option(papers_option_, papers_text_, what)->type_name("A3,A1");
  declare_title_block(app);
}

void SheetOptions::declare_file(CLI::App& app) {
  begin_group(app, kMapsOnPaper);
  writes(app.add_option("--sheet", file_,
                        "A map on paper, to scale, with title block, legend, grid references and sources (.pdf, .png)")
             ->type_name("FILE"));
  papers_option_ = "--paper";
  app.add_option(papers_option_, papers_text_, "Paper size of --sheet (default: A3)")->type_name("A3|A1");
  declare_title_block(app);
}

void SheetOptions::declare_title_block(CLI::App& app) {
  app.add_option("--sheet-scale", scale_text_,
                 "Scale of the maps on paper: 100000 for 1:100,000 (default: the largest usual one that shows all)")
      ->type_name("NUMBER");
  reads(app.add_option("--basemap", choice_.basemap,
                       "A georeferenced picture below these maps, in place of the shaded relief (.tif, ...)")
            ->type_name("FILE"));
  add_names(app);
}

void SheetOptions::declare_names(CLI::App& app) {
  begin_group(app, kMapsOnPaper);
  add_names(app);
}

void SheetOptions::add_names(CLI::App& app) {
  app.add_option("--project", choice_.project, "The project's name in title blocks")->type_name("NAME");
  app.add_option("--date", choice_.date, "The date in title blocks (default: today, UTC)")->type_name("TEXT");
}

void SheetOptions::validate(bool names_unasked) {
  const bool alone = papers_option_ == "--paper" && file_.empty();
  if (alone && !papers_text_.empty()) throw InputError("--paper works only with --sheet");
  if (!file_.empty() && papers_text_.empty()) papers_text_ = "A3";
  const auto require_sheet = [&](const char* option, const std::string& text) {
    if (!text.empty() && papers_text_.empty()) throw InputError(fmt::format("{} works only with a sheet", option));
  };
  require_sheet("--basemap", choice_.basemap), require_sheet("--sheet-scale", scale_text_);
  if (!names_unasked) require_sheet("--project", choice_.project), require_sheet("--date", choice_.date);
  if (choice_.date.empty()) choice_.date = day_text(day_of_run());
  if (!file_.empty()) profile::require_sheet_format(file_);
  if (!scale_text_.empty()) choice_.scale = parse_number("--sheet-scale", scale_text_, Range::kPositive);
  if (papers_text_.empty()) return;
  std::istringstream names(papers_text_);
  for (std::string name; std::getline(names, name, ',');)
    choice_.papers.push_back(parse_choice(papers_option_, name, {"A3", "A1"}) == 0 ? profile::PaperSize::kA3
                                                                                   : profile::PaperSize::kA1);
}

Document SheetOptions::parameters() const {
  Document parameters = Document::object();
  for (const profile::PaperSize paper : choice_.papers) parameters["sheets"].push_back(profile::name_of(paper));
  if (choice_.scale > 0) parameters["sheet_scale"] = choice_.scale;
  if (!choice_.basemap.empty()) parameters["basemap"] = choice_.basemap;
  if (!choice_.project.empty()) parameters["project"] = choice_.project;
  return parameters;
}

}  // namespace itin::cli
