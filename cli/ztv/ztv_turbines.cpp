#include "ztv/ztv_turbines.hpp"

#include <algorithm>
#include <cctype>
#include <map>
#include <utility>

#include <fmt/format.h>

#include <itin/decimal_comma.hpp>
#include <itin/error.hpp>
#include <itin/file_digest.hpp>
#include <itin/position_columns.hpp>
#include <itin/progress.hpp>
#include <itin/site_list.hpp>

#include "program/call_files.hpp"
#include "program/field_names.hpp"
#include "program/help.hpp"
#include "program/values.hpp"

namespace itin::cli {

namespace {

enum Field : std::size_t { kHub, kRotor, kTip, kFarm, kName };

std::optional<double> number_in_row(const char* name, const std::optional<std::string>& text) {
  return text ? std::optional(parse_height(name, with_decimal_point(*text), Range::kPositive)) : std::nullopt;
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
  return fmt::format("{}: row {} ({}) is not used: {}", file, row.number, row.place, row.message);
}

namespace {

/// Warns of fields that seem to hold a size of turbines, and are not read.
void warn_of_likely_sizes(const std::string& file, const LayerFields& layer, const std::vector<SiteField>& read,
                          std::vector<std::string>& warnings) {
  constexpr std::pair<const char*, const char*> kSizes[] = {{"hub", "--hub-height-field"},
                                                            {"rotor", "--rotor-diameter-field"},
                                                            {"blade", "--tip-height-field"},
                                                            {"tip", "--tip-height-field"},
                                                            {"height", "--tip-height-field"}};
  for (const std::string& name : layer.names()) {
    const auto is_it = [&](const SiteField& field) { return same_column_name(field.name, name); };
    if (std::any_of(read.begin(), read.end(), is_it)) continue;
    std::string lower = name;
    std::transform(lower.begin(), lower.end(), lower.begin(), [](unsigned char c) { return std::tolower(c); });
    const auto size = std::find_if(std::begin(kSizes), std::end(kSizes),
                                   [&](const auto& s) { return lower.find(s.first) != std::string::npos; });
    if (size != std::end(kSizes))
      warnings.push_back(
          fmt::format("{}: its field '{}' is not used; {} '{}' would use it", file, name, size->second, name));
  }
}

/// Warns of turbines at one place: they count twice, which is seldom meant.
void warn_of_duplicates(const std::string& file, TurbineList& list) {
  std::map<std::pair<double, double>, std::size_t> first;
  for (const viewshed::Turbine& t : list.turbines) {
    const auto [at, fresh] = first.emplace(std::pair(t.position.x, t.position.y), t.number);
    if (!fresh)
      list.warnings.push_back(fmt::format("{}: row {} stands at the same place as row {}, {:.10g},{:.10g}; both count",
                                          file, t.number, at->second, t.position.x, t.position.y));
  }
}

}  // namespace

void TurbineOptions::declare(CLI::App& app) {
  begin_group(app, "Turbines");
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
  size_.declare(app, "of turbines whose row gives none");
  app.add_option("--farm", farm_, "Farm of turbines whose row gives none")->type_name("NAME");
  in_crs_.declare(app);
}

void TurbineOptions::validate() {
  size_.validate();
  query_.crs = in_crs_.crs;
}

viewshed::Turbine TurbineOptions::turbine_of(const SiteRow& row) const {
  if (!row.position) throw InputError(row.error);
  TurbineSize size{number_in_row("its hub_height", row.values[kHub]),
                   number_in_row("its rotor_diameter", row.values[kRotor]),
                   number_in_row("its tip_height", row.values[kTip])};
  // Options supply sizes that the row leaves open, but not a size that follows from two of the row's own.
  const bool is_complete = (size.hub && size.rotor) || (size.tip && (size.hub || size.rotor));
  if (!is_complete) {
    const TurbineSize& otherwise = size_.size();
    if (!size.hub) size.hub = otherwise.hub;
    if (!size.rotor && !(size.hub && size.tip)) size.rotor = otherwise.rotor;
    if (!size.tip && !(size.hub && size.rotor)) size.tip = otherwise.tip;
  }
  size.complete();
  viewshed::Turbine turbine;
  turbine.position = *row.position;
  turbine.tip_height = *size.tip, turbine.hub_height = size.hub, turbine.rotor_diameter = size.rotor;
  turbine.farm = row.values[kFarm].value_or(farm_);
  return turbine;
}

TurbineList TurbineOptions::read(const StoreMetadata& metadata, const std::function<double(double)>& radius) const {
  // A field that was asked for has to be there.
  const auto field = [](const std::string& name, const char* usual) { return SiteField{name, name != usual}; };
  const LayerFields layer(query_);
  const std::string names = query_.name_field.empty() ? name_field_of(layer).value_or(kNameField) : query_.name_field;
  const std::vector<SiteField> fields{field(hub_field_, kHubField), field(rotor_field_, kRotorField),
                                      field(tip_field_, kTipField), field(farm_field_, kFarmField),
                                      SiteField{names, !query_.name_field.empty()}};
  TurbineList list;
  const auto rows = read_site_rows(query_, fields, metadata.crs_wkt, list.warnings);
  warn_of_likely_sizes(query_.path, layer, fields, list.warnings);
  NoProgress quiet;
  list.sha256 = file_sha256(query_.path, quiet);
  for (const SiteRow& row : rows) {
    const std::size_t k = ++list.rows;
    list.places.emplace_back(row.feature, row.place);
    try {
      viewshed::Turbine turbine = turbine_of(row);
      turbine.number = k;
      turbine.name = row.values[kName].value_or(fmt::format("{}", k));
      turbine.radius = radius(turbine.tip_height);
      list.turbines.push_back(std::move(turbine));
    } catch (const InputError& error) {
      list.bad.push_back({k, row.feature, row.place, in_options(error.what())});
    }
  }
  warn_of_duplicates(query_.path, list);
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
  text("layer", query_.layer), text("where", query_.where), text("name_field", query_.name_field);
  parameters.update(size_.parameters());
  if (hub_field_ != kHubField) parameters["hub_height_field"] = hub_field_;
  if (rotor_field_ != kRotorField) parameters["rotor_diameter_field"] = rotor_field_;
  if (tip_field_ != kTipField) parameters["tip_height_field"] = tip_field_;
  if (farm_field_ != kFarmField) parameters["farm_field"] = farm_field_;
  text("farm", farm_), text("in_crs", in_crs_.crs);
  return parameters;
}

}  // namespace itin::cli
