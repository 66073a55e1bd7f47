#include "ztv/ztv_turbines.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <fmt/format.h>

#include <itin/error.hpp>
#include <itin/file_digest.hpp>
#include <itin/progress.hpp>

#include "options/site_list.hpp"
#include "program/call_files.hpp"
#include "program/field_names.hpp"
#include "program/values.hpp"

namespace itin::cli {

namespace {

enum Field : std::size_t { kHub, kRotor, kTip, kFarm, kName };

std::optional<double> number(const char* name, const std::optional<std::string>& text,
                             const std::optional<double>& otherwise) {
  return text ? parse_height(name, *text, Range::kPositive) : otherwise;
}

/// Completes the one of hub, rotor and tip that the other two imply.
void complete(std::optional<double>& hub, std::optional<double>& rotor, std::optional<double>& tip) {
  if (!tip) {
    if (!hub || !rotor) throw InputError("it has neither tip_height nor both hub_height and rotor_diameter");
    tip = *hub + *rotor / 2;
  } else if (hub && *hub > *tip) {
    throw InputError(fmt::format("its hub_height {:g} lies above its tip_height {:g}", *hub, *tip));
  } else if (hub && !rotor && *tip > *hub) {
    rotor = 2 * (*tip - *hub);
  } else if (!hub && rotor) {
    hub = *tip - *rotor / 2;
  }
  if (hub && *hub <= 0)
    throw InputError("its rotor_diameter is more than twice its tip_height: the hub would lie below the ground");
  if (hub && rotor && *rotor / 2 > *hub)
    throw InputError(fmt::format("its blades would reach {:g} m below the ground: hub {:g}, rotor {:g}",
                                 *rotor / 2 - *hub, *hub, *rotor));
  if (hub && rotor && std::abs(*hub + *rotor / 2 - *tip) > 1)
    throw InputError(
        fmt::format("its heights contradict each other: hub {:g} and half the rotor {:g} are not the tip {:g}", *hub,
                    *rotor / 2, *tip));
}

}  // namespace

Document bad_rows_document(const std::string& file, std::size_t rows, std::size_t used,
                           const std::vector<BadRow>& bad) {
  Document document{{"file", file}, {"rows", rows}, {"used", used}, {"bad", Document::array()}};
  for (const BadRow& row : bad)
    document["bad"].push_back({{"row", row.number}, {"feature", row.feature}, {"message", row.message}});
  return document;
}

std::string bad_row_warning(const std::string& file, const BadRow& row) {
  return fmt::format("{}: row {} (feature {}) is not used: {}", file, row.number, row.feature, row.message);
}

std::size_t known_hubs(const std::vector<viewshed::Turbine>& turbines) {
  return static_cast<std::size_t>(std::count_if(turbines.begin(), turbines.end(),
                                                [](const viewshed::Turbine& t) { return t.hub_height.has_value(); }));
}

namespace {

/// Two turbines at one place count twice, which is seldom meant.
void warn_of_duplicates(TurbineList& list) {
  std::map<std::pair<double, double>, std::size_t> first;
  for (const viewshed::Turbine& t : list.turbines) {
    const auto [at, fresh] = first.emplace(std::pair(t.position.x, t.position.y), t.number);
    if (!fresh)
      list.warnings.push_back(fmt::format("row {} stands at the same place as row {}, {:.10g},{:.10g}; both count",
                                          t.number, at->second, t.position.x, t.position.y));
  }
}

}  // namespace

void TurbineOptions::declare(CLI::App& app) {
  reads(app.add_option(
               "--turbines", query_.path,
               "The turbines, from a vector file of points, or CSV with columns x,y or lon,lat. Fields hub_height and "
               "rotor_diameter, or tip_height; farm; name. Turbine k has bit k - 1 in turbines.tif")
            ->required()
            ->type_name("FILE"));
  app.add_option("--layer", query_.layer, "The layer of that file")->type_name("NAME");
  app.add_option("--where", query_.where, "Only turbines that this SQL condition holds for")->type_name("SQL");
  app.add_option("--name-field", query_.name_field, "The field of that file that holds names (default: name)")
      ->type_name("FIELD");
  const auto field = [&](const char* option, std::string& name, const char* what) {
    app.add_option(option, name, fmt::format("The field of that file that holds {} (default: {})", what, name))
        ->type_name("FIELD");
  };
  field("--hub-height-field", hub_field_, "hub heights");
  field("--rotor-diameter-field", rotor_field_, "rotor diameters");
  field("--tip-height-field", tip_field_, "heights of blade tips");
  field("--farm-field", farm_field_, "farms");
  app.add_option("--hub-height", hub_text_, "Hub height of turbines whose row gives none")->type_name("METRES");
  app.add_option("--rotor-diameter", rotor_text_, "Rotor diameter of turbines whose row gives none")
      ->type_name("METRES");
  app.add_option("--tip-height", tip_text_, "Height of the highest blade tip, of turbines whose row gives none")
      ->type_name("METRES");
  app.add_option("--farm", farm_, "Farm of turbines whose row gives none")->type_name("NAME");
  in_crs_.declare(app);
}

void TurbineOptions::validate() {
  if (!hub_text_.empty()) hub_ = parse_height("--hub-height", hub_text_, Range::kPositive);
  if (!rotor_text_.empty()) rotor_ = parse_height("--rotor-diameter", rotor_text_, Range::kPositive);
  if (!tip_text_.empty()) tip_ = parse_height("--tip-height", tip_text_, Range::kPositive);
  query_.crs = in_crs_.crs;
  require_options_of_one_turbine();
}

void TurbineOptions::require_options_of_one_turbine() const {
  if (!tip_ || !(hub_ || rotor_)) return;
  std::optional<double> hub = hub_, rotor = rotor_, tip = tip_;
  try {
    complete(hub, rotor, tip);
  } catch (const InputError& error) {
    throw InputError(fmt::format(
        "--hub-height, --rotor-diameter, --tip-height: no turbine can have these, {}; leave out or correct one of them",
        in_options(error.what())));
  }
}

viewshed::Turbine TurbineOptions::turbine_of(const SiteRow& row) const {
  if (!row.position) throw InputError(row.error);
  std::optional<double> hub = number("its hub_height", row.values[kHub], std::nullopt);
  std::optional<double> rotor = number("its rotor_diameter", row.values[kRotor], std::nullopt);
  std::optional<double> tip = number("its tip_height", row.values[kTip], std::nullopt);
  // Options fill in what the row leaves open, not what two of its own values settle.
  const bool settled = (hub && rotor) || (tip && (hub || rotor));
  if (!settled) {
    if (!hub) hub = hub_;
    if (!rotor && !(hub && tip)) rotor = rotor_;
    if (!tip && !(hub && rotor)) tip = tip_;
  }
  complete(hub, rotor, tip);
  viewshed::Turbine turbine;
  turbine.position = *row.position;
  turbine.tip_height = *tip, turbine.hub_height = hub, turbine.rotor_diameter = rotor;
  turbine.farm = row.values[kFarm].value_or(farm_);
  return turbine;
}

TurbineList TurbineOptions::read(const StoreMetadata& metadata, const std::function<double(double)>& radius) const {
  const std::string name_field = query_.name_field.empty() ? "name" : query_.name_field;
  const auto rows =
      read_site_rows(query_, {hub_field_, rotor_field_, tip_field_, farm_field_, name_field}, metadata.crs_wkt);
  TurbineList list;
  NoProgress quiet;
  list.sha256 = file_sha256(query_.path, quiet);
  for (const SiteRow& row : rows) {
    const std::size_t k = ++list.rows;
    list.features.push_back(row.feature);
    try {
      viewshed::Turbine turbine = turbine_of(row);
      turbine.number = k;
      turbine.name = row.values[kName].value_or(fmt::format("{}", k));
      turbine.radius = radius(turbine.tip_height);
      list.turbines.push_back(std::move(turbine));
    } catch (const InputError& error) {
      list.bad.push_back({k, row.feature, in_options(error.what())});
    }
  }
  warn_of_duplicates(list);
  if (list.rows == 0) throw InputError(none_in(query_, "turbine"));
  if (list.turbines.empty())
    throw InputError(fmt::format("{}: none of its rows can be used ({} in all); the first: {}", query_.path, list.rows,
                                 list.bad.front().message));
  return list;
}

Document TurbineOptions::parameters() const {
  Document parameters{{"turbines", query_.path}};
  const auto text = [&](const char* name, const std::string& value) {
    if (!value.empty()) parameters[name] = value;
  };
  const auto metres = [&](const char* name, const std::optional<double>& value) {
    if (value) parameters[name] = *value;
  };
  text("layer", query_.layer), text("where", query_.where), text("name_field", query_.name_field);
  metres("hub_height_m", hub_), metres("rotor_diameter_m", rotor_), metres("tip_height_m", tip_);
  if (hub_field_ != "hub_height") parameters["hub_height_field"] = hub_field_;
  if (rotor_field_ != "rotor_diameter") parameters["rotor_diameter_field"] = rotor_field_;
  if (tip_field_ != "tip_height") parameters["tip_height_field"] = tip_field_;
  if (farm_field_ != "farm") parameters["farm_field"] = farm_field_;
  text("farm", farm_), text("in_crs", in_crs_.crs);
  return parameters;
}

}  // namespace itin::cli
