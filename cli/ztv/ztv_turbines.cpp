#include "ztv/ztv_turbines.hpp"

#include <fmt/format.h>

#include <itin/error.hpp>

#include "options/places/off_the_data.hpp"
#include "program/call_files.hpp"
#include "program/field_names.hpp"
#include "program/help.hpp"

namespace itin::cli {

void TurbineOptions::declare(CLI::App& app) {
  begin_group(app, "Turbines");
  const std::string bits = use_ == Use::zone ? ". Turbine k has bit k - 1 in turbines.tif" : "";
  reads(app.add_option(
               "--turbines", file_.path,
               "The turbines, from a vector file of points, or CSV with columns x,y or lon,lat. Fields hub_height and "
               "rotor_diameter, or tip_height; farm; name" +
                   bits)
            ->required()
            ->type_name("FILE"));
  app.add_option("--layer", file_.layer, "The layer of that file")->type_name("NAME");
  app.add_option("--where", file_.where, "Only turbines that this SQL condition holds for")->type_name("SQL");
  app.add_option("--name-field", file_.name_field, "The field of that file that holds names (default: name)")
      ->type_name("FIELD");
  const auto field = [&](const char* option, std::string& name, const char* what) {
    app.add_option(option, name, fmt::format("The field of that file that holds {} (default: {})", what, name))
        ->type_name("FIELD");
  };
  field("--hub-height-field", file_.hub_height_field, "hub heights");
  field("--rotor-diameter-field", file_.rotor_diameter_field, "rotor diameters");
  field("--tip-height-field", file_.tip_height_field, "heights of blade tips");
  field("--farm-field", file_.farm_field, "farms");
  field(
      "--status-field", file_.status_field,
      use_ == Use::zone
          ? "whether each is proposed, consented or existing: with others, the study area is about the proposed ones, "
            "and what they add is told"
          : "whether each is proposed, consented or existing, as the map and the layer of turbines tell");
  app.add_option("--proposal", file_.proposal,
                 "The farm that is the proposal; other farms, proposed ones too, stand beside it (default: all "
                 "proposed turbines)")
      ->type_name("FARM");
  size_.declare(app, "of turbines whose row gives none");
  app.add_option("--farm", file_.farm, "Farm of turbines whose row gives none")->type_name("NAME");
  in_crs_.declare(app);
}

void TurbineOptions::validate() {
  size_.validate();
  file_.crs = in_crs_.crs, file_.size = size_.size();
}

viewshed::TurbineTable TurbineOptions::read(const viewshed::RadiusRule& radius, const StoreMetadata& metadata) const {
  viewshed::TurbineFile file = file_;
  file.radius = radius;
  viewshed::TurbineTable table = viewshed::read_turbines(file, metadata.crs_wkt);
  for (viewshed::BadRow& row : table.bad) row.message = in_options(row.message);
  std::vector<Point2> places;
  for (const viewshed::Turbine& turbine : table.turbines) places.push_back(turbine.position);
  require_any_on_the_data(file_.path + ": the first turbine", places, in_crs_, metadata);
  return table;
}

Document TurbineOptions::parameters() const {
  const viewshed::TurbineFile usual;
  Document parameters{{"turbines", file_.path}};
  const auto text = [&](const char* name, const std::string& value) {
    if (!value.empty()) parameters[name] = value;
  };
  text("layer", file_.layer), text("where", file_.where), text("name_field", file_.name_field);
  parameters.update(size_.parameters());
  if (file_.hub_height_field != usual.hub_height_field) parameters["hub_height_field"] = file_.hub_height_field;
  if (file_.rotor_diameter_field != usual.rotor_diameter_field)
    parameters["rotor_diameter_field"] = file_.rotor_diameter_field;
  if (file_.tip_height_field != usual.tip_height_field) parameters["tip_height_field"] = file_.tip_height_field;
  if (file_.farm_field != usual.farm_field) parameters["farm_field"] = file_.farm_field;
  if (file_.status_field != usual.status_field) parameters["status_field"] = file_.status_field;
  text("proposal", file_.proposal), text("farm", file_.farm), text("in_crs", in_crs_.crs);
  return parameters;
}

}  // namespace itin::cli
