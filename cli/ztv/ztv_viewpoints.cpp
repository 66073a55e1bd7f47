#include "ztv/ztv_viewpoints.hpp"

#include <sstream>

#include <fmt/format.h>

#include <itin/error.hpp>

#include "program/call_files.hpp"
#include "program/field_names.hpp"
#include "program/help.hpp"
#include "program/values.hpp"

namespace itin::cli {

void ViewpointOptions::declare(CLI::App& app) {
  begin_group(app, "Viewpoints and wirelines");
  reads(app.add_option("--viewpoints", file_.path,
                       "Viewpoints for tables and wirelines, from a vector file of points, or CSV with columns x,y or "
                       "lon,lat; fields "
                       "name, and height for eyes that stand higher or lower than --observer-height")
            ->type_name("FILE"));
  app.add_option("--wireline-field", field_text_, "Least width of a wireline (default: 53.5)")->type_name("DEGREES");
  app.add_option("--wireline-bearing", bearing_text_,
                 "Bearing of every wireline's middle, from grid north (default: the middle of the turbines that are "
                 "seen, or of all where none is; sheets too narrow for them look at the nearest that is seen)")
      ->type_name("DEGREES");
  app.add_flag("--wireline-hidden", choice_.hidden_dashed, "Draw the hidden parts of turbines dashed in wirelines");
  app.add_option("--wireline-blades", blades_text_,
                 "By how much a blade is turned from upright in wirelines; random: by another angle for each turbine "
                 "(default: 0)")
      ->type_name("DEGREES|random");
  app.add_option("--wireline-pairs", choice_.alone,
                 "Cylindrical sheets in pairs: above, this wind farm alone; below, all of them")
      ->type_name("FARM");
  app.add_option("--wirelines", wirelines_text_, "Wirelines only from viewpoints of these names or numbers")
      ->type_name("NAME,...");
  app.add_flag("--no-wirelines", choice_.none, "Write tables of viewpoints alone");
}

void ViewpointOptions::validate(const InCrs& in_crs, bool sheets) {
  file_.crs = in_crs.crs;
  const std::pair<bool, const char*> options[] = {
      {!field_text_.empty(), "--wireline-field"},   {!bearing_text_.empty(), "--wireline-bearing"},
      {!blades_text_.empty(), "--wireline-blades"}, {!choice_.alone.empty(), "--wireline-pairs"},
      {!wirelines_text_.empty(), "--wirelines"},    {choice_.none, "--no-wirelines"},
      {choice_.hidden_dashed, "--wireline-hidden"}};
  for (const auto& [is_given, option] : options)
    if (is_given && !given()) throw InputError(fmt::format("{} works only with --viewpoints", option));
  if (choice_.none && !wirelines_text_.empty()) throw InputError("--wirelines and --no-wirelines exclude each other");
  if (!field_text_.empty()) choice_.least_width_deg = parse_number("--wireline-field", field_text_, Range::kPositive);
  if (choice_.least_width_deg > 360) throw InputError("--wireline-field: give at most 360 degrees");
  if (!bearing_text_.empty()) choice_.bearing_deg = parse_bearing("--wireline-bearing", bearing_text_);
  if (!choice_.alone.empty() && !sheets)
    throw InputError("--wireline-pairs are sheets: give --sheets A3 or A1 with it");
  if (blades_text_ == "random") {
    choice_.blade_deg.reset();
  } else if (!blades_text_.empty()) {
    choice_.blade_deg = parse_number("--wireline-blades", blades_text_, Range::kNotNegative);
  }
  std::istringstream names(wirelines_text_);
  for (std::string name; std::getline(names, name, ',');) choice_.viewpoints.push_back(name);
}

Document ViewpointOptions::parameters() const {
  if (!given()) return Document::object();
  Document parameters{{"viewpoints", file_.path}, {"wireline_field_deg", choice_.least_width_deg}};
  if (choice_.bearing_deg) parameters["wireline_bearing_deg"] = *choice_.bearing_deg;
  if (choice_.hidden_dashed) parameters["wireline_hidden"] = true;
  if (!blades_text_.empty()) parameters["wireline_blades"] = blades_text_;
  if (!choice_.alone.empty()) parameters["wireline_pairs"] = choice_.alone;
  if (!choice_.viewpoints.empty()) parameters["wirelines"] = choice_.viewpoints;
  if (choice_.none) parameters["wirelines"] = Document::array();
  return parameters;
}

void ViewpointOptions::complete(viewshed::ZoneStudyRequest& request, const StoreMetadata& metadata) const {
  if (!given()) return;
  request.viewpoints = viewshed::read_viewpoints(file_, metadata.crs_wkt, request.zone.observer_height);
  for (viewshed::BadRow& row : request.viewpoints.bad) row.message = in_options(row.message);
}

}  // namespace itin::cli
