#include "los/los_links.hpp"

#include <algorithm>

#include <fmt/format.h>

#include <itin/error.hpp>
#include <profile/documents.hpp>

#include "options/memory_option.hpp"
#include "options/places/off_the_data.hpp"
#include "output/store_document.hpp"
#include "program/call_files.hpp"
#include "program/help.hpp"
#include "program/values.hpp"

namespace itin::cli {

namespace {

/// The first error: of rows that cannot be read or, if there are none, of links.
std::string first_error(const profile::LinkSurvey& survey) {
  const profile::LinkTable& table = survey.table;
  if (!table.bad.empty()) return fmt::format("{}: {}", table.bad.front().place, table.bad.front().message);
  const auto first =
      std::find_if(survey.results.begin(), survey.results.end(), [](const profile::LinkResult& r) { return !r.found; });
  const profile::Link& link = table.links[static_cast<std::size_t>(first - survey.results.begin())];
  const Point2 end = is_on_the_data(link.from, survey.metadata) ? link.to : link.from;
  const std::optional<std::string> off = off_the_data(end, {}, survey.metadata);
  const std::string where = off ? fmt::format("; {:.10g},{:.10g} {}", end.x, end.y, *off) : "";
  return fmt::format("{}: {}{}", link.id, first->message, where);
}

}  // namespace

void LosLinks::declare(CLI::App& app) {
  begin_group(app, "Many links");
  reads(app.add_option(
               "--links", path_,
               "Many links: a table id,x1,y1,h1,x2,y2,h2 (.csv; also lon1,lat1,lon2,lat2, or position1,position2 with "
               "grid references; without id, name or link: rows are numbered from 1; and "
               "name1,name2,frequency,polarisation,criteria of each, and its link budget: power_dbm, gain1_dbi, "
               "gain2_dbi, "
               "...), or a file of lines")
            ->type_name("FILE"));
  app.add_option("--link-height", height_text_,
                 "Height of both ends of the lines of a file (default: 2, and at the second end the tip of "
                 "--visible-height)")
      ->type_name("METRES");
  app.add_option("--layer", choice_.layer, "The layer of a file of lines (default: all layers)")->type_name("NAME");
  app.add_option("--where", choice_.where, "Only lines of a file that this SQL condition holds for")->type_name("SQL");
  writes(app.add_option("-o,--output", outputs_,
                        "With --links: what to write: the table (.csv), the links as lines with its columns (.gpkg, "
                        ".kml), a page that sums them up (.pdf); may be given again")
             ->type_name("FILE")
             ->expected(1)
             ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll));
}

void LosLinks::validate(const std::optional<profile::TallObject>& object) {
  if (outputs_.empty()) throw InputError("--links needs -o FILE.csv, the table to write");
  for (const std::string& output : outputs_) profile::require_link_format(output);
  if (object) heights_.to_m = object->tip_m;
  if (height_text_.empty()) return;
  heights_.from_m = heights_.to_m = parse_height("--link-height", height_text_, Range::kNotNegative);
}

void LosLinks::require_none() const {
  if (!outputs_.empty())
    throw InputError(fmt::format("-o '{}' works only with --links; for one line give --report", outputs_.front()));
  for (const auto& [option, text] : {std::pair("--link-height", &height_text_), std::pair("--layer", &choice_.layer),
                                     std::pair("--where", &choice_.where)})
    if (!text->empty()) throw InputError(fmt::format("{} works only with --links", option));
}

Document LosLinks::parameters() const {
  Document parameters{{"links", path_}, {"link_height_m", heights_.from_m}, {"link_height_to_m", heights_.to_m}};
  if (!choice_.layer.empty()) parameters["layer"] = choice_.layer;
  if (!choice_.where.empty()) parameters["where"] = choice_.where;
  return parameters;
}

profile::LinkTable LosLinks::table(const Store& store, const LosStoreOptions& surface) const {
  return profile::read_link_table(path_, store.metadata().crs_wkt, heights_, surface.in_crs(), choice_);
}

profile::LinkQuery LosLinks::query(const profile::LosQuery& line, const LosStoreOptions& surface) {
  return {.earth = line.earth,
          .detail = surface.detail(),
          .themes = surface.themes(),
          .from_on_surface = surface.from_on_surface(),
          .to_on_surface = surface.to_on_surface(),
          .radio = line.radio,
          .budget = line.budget,
          .criteria = line.criteria,
          .object = line.object,
          .nodata = surface.nodata(),
          .sections = section_cache_within(surface.memory_bytes()),
          .day = line.day};
}

Result LosLinks::result_of(const profile::LinkSurvey& survey) const {
  Result result;
  result.document = profile::links_document(survey);
  result.document["outputs"] = outputs_;
  const profile::LinkCounts counts = profile::counts_of(survey);
  const std::string all = counted(survey.results.size() + survey.table.bad.size(), "link");
  result.text = fmt::format("{}: {}, {} visible", outputs_.front(), all, grouped(counts.visible));
  if (counts.undecided > 0) result.text += fmt::format(", {} undecided", grouped(counts.undecided));
  result.text += "\n";
  result.warnings = survey.warnings;
  if (counts.error > 0)
    result.failure = fmt::format("{}: {} of {} could not be computed; see the column message; one of them: {}",
                                 outputs_.front(), counts.error, all, first_error(survey));
  return result;
}

}  // namespace itin::cli
