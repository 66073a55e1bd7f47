// Reads turbines: rows of a file, understood or named as bad.
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include <fmt/format.h>

#include <itin/counted.hpp>
#include <itin/decimal_comma.hpp>
#include <itin/error.hpp>
#include <itin/file_digest.hpp>
#include <itin/lower_case.hpp>
#include <itin/parsed_number.hpp>
#include <itin/position_columns.hpp>
#include <itin/progress.hpp>
#include <itin/site_list.hpp>
#include <itin/site_table.hpp>
#include <viewshed/zone_study.hpp>

#include "workflows/zone/usable_rows.hpp"

namespace itin::viewshed {

namespace {

enum TurbineField : std::size_t { kHub, kRotor, kTip, kFarm, kName, kStatus };

/// Tells whether a size is written as 0, which databases have where it is not known.
bool is_zero(const std::optional<std::string>& text) {
  return text && whole_text_as<double>(with_decimal_point(*text)) == 0.0;
}

std::optional<double> number_in_row(const char* name, const std::optional<std::string>& text) {
  if (!text || is_zero(text)) return std::nullopt;
  return parse_height(name, with_decimal_point(*text), NumberRange::kPositive);
}

void warn_of_zeros(const std::string& file, const std::vector<SiteRow>& rows, std::vector<std::string>& warnings) {
  const auto zeros = std::count_if(rows.begin(), rows.end(), [](const SiteRow& row) {
    return is_zero(row.values[kHub]) || is_zero(row.values[kRotor]) || is_zero(row.values[kTip]);
  });
  if (zeros == 0) return;
  warnings.push_back(fmt::format("{}: {} {} a size of 0, which is taken as missing", file,
                                 counted(static_cast<std::uint64_t>(zeros), "row"), zeros == 1 ? "has" : "have"));
}

/// Warns of fields that seem to hold a size of turbines, and are not read.
void warn_of_likely_sizes(const std::string& file, const LayerFields& layer, const std::vector<SiteField>& read,
                          std::vector<std::string>& warnings) {
  constexpr std::pair<const char*, const char*> kSizes[] = {{"hub", "`hub_height_field`"},
                                                            {"rotor", "`rotor_diameter_field`"},
                                                            {"blade", "`tip_height_field`"},
                                                            {"tip", "`tip_height_field`"},
                                                            {"height", "`tip_height_field`"}};
  for (const std::string& name : layer.names()) {
    const auto is_it = [&](const SiteField& field) { return same_column_name(field.name, name); };
    if (std::any_of(read.begin(), read.end(), is_it)) continue;
    const std::string lower = in_lower_case(name);
    const auto size = std::find_if(std::begin(kSizes), std::end(kSizes),
                                   [&](const auto& s) { return lower.find(s.first) != std::string::npos; });
    if (size != std::end(kSizes))
      warnings.push_back(
          fmt::format("{}: its field '{}' is not used; {} '{}' would use it", file, name, size->second, name));
  }
}

/// Warns of turbines at one place: they count twice, which is seldom meant.
void warn_of_duplicates(const std::string& file, TurbineTable& list) {
  std::map<std::pair<double, double>, std::size_t> first;
  for (const Turbine& t : list.turbines) {
    const auto [at, fresh] = first.emplace(std::pair(t.position.x, t.position.y), t.number);
    if (!fresh)
      list.warnings.push_back(fmt::format("{}: row {} stands at the same place as row {}, {:.10g},{:.10g}; both count",
                                          file, t.number, at->second, t.position.x, t.position.y));
  }
}

/// Returns the size that a row states. The file's size supplies what the row leaves open, but not a size that follows
/// from two of the row's own. Throws InputError with what is wrong with the row.
TurbineSize size_in_row(const SiteRow& row, const TurbineSize& otherwise) {
  TurbineSize size{number_in_row("its hub_height", row.values[kHub]),
                   number_in_row("its rotor_diameter", row.values[kRotor]),
                   number_in_row("its tip_height", row.values[kTip])};
  const bool is_complete = (size.hub && size.rotor) || (size.tip && (size.hub || size.rotor));
  if (!is_complete) {
    if (!size.hub) size.hub = otherwise.hub;
    if (!size.rotor && !(size.hub && size.tip)) size.rotor = otherwise.rotor;
    if (!size.tip && !(size.hub && size.rotor)) size.tip = otherwise.tip;
  }
  size.complete();
  return size;
}

/// Returns the status that a word of planners stands for.
std::optional<TurbineStatus> status_of(const std::string& word) {
  using enum TurbineStatus;
  static const std::map<std::string, TurbineStatus> kWords{{"proposed", kProposed},
                                                           {"proposal", kProposed},
                                                           {"planned", kProposed},
                                                           {"application", kProposed},
                                                           {"application submitted", kProposed},
                                                           {"consented", kConsented},
                                                           {"approved", kConsented},
                                                           {"granted", kConsented},
                                                           {"planning permission granted", kConsented},
                                                           {"awaiting construction", kConsented},
                                                           {"under construction", kConsented},
                                                           {"existing", kExisting},
                                                           {"built", kExisting},
                                                           {"operational", kExisting}};
  const auto known = kWords.find(in_lower_case(word));
  return known == kWords.end() ? std::nullopt : std::optional(known->second);
}

/// Tells whether the field of status counts: where a call names it, or a row is proposed; with the farm of the proposal
/// given, where a row has any status. Otherwise a field of that name may mean something else.
bool tells_status(const TurbineFile& file, const std::vector<SiteRow>& rows) {
  if (file.status_field.empty()) return false;
  return file.status_field != TurbineFile().status_field ||
         std::any_of(rows.begin(), rows.end(), [&](const SiteRow& row) {
           const auto status = status_of(row.values[kStatus].value_or(""));
           return status && (!file.proposal.empty() || *status == TurbineStatus::kProposed);
         });
}

TurbineStatus status_in_row(const SiteRow& row) {
  const std::string word = row.values[kStatus].value_or("");
  if (const auto status = status_of(word)) return *status;
  throw InputError(fmt::format("its status '{}' is not proposed, consented or existing", word));
}

/// Returns the turbine's status. The farm of the proposal needs none in its rows, and what else is proposed is in
/// planning beside it.
std::optional<TurbineStatus> status_of_turbine(const Turbine& turbine, const SiteRow& row, const TurbineFile& file,
                                               bool with_status) {
  using enum TurbineStatus;
  if (!file.proposal.empty() && turbine.farm == file.proposal) return kProposed;
  if (!with_status) return std::nullopt;
  const TurbineStatus status = status_in_row(row);
  return status == kProposed && !file.proposal.empty() ? kInPlanning : status;
}

/// Throws InputError where no turbine is of the farm that is to be the proposal.
void require_proposal(const TurbineFile& file, const std::vector<Turbine>& turbines) {
  if (file.proposal.empty()) return;
  std::set<std::string> farms;
  for (const Turbine& turbine : turbines) farms.insert(turbine.farm.empty() ? "(no farm)" : turbine.farm);
  if (!farms.contains(file.proposal))
    throw InputError(fmt::format("`proposal`: {} has no turbine of the farm '{}'; its farms are {}", file.path,
                                 file.proposal, fmt::join(farms, ", ")),
                     "proposal");
}

Turbine turbine_of(const SiteRow& row, std::size_t number, const TurbineFile& file) {
  if (!row.position) throw InputError(row.error);
  const TurbineSize size = size_in_row(row, file.size);
  Turbine turbine;
  turbine.number = number;
  turbine.position = *row.position;
  turbine.tip_height = *size.tip, turbine.hub_height = size.hub, turbine.rotor_diameter = size.rotor;
  turbine.farm = row.values[kFarm].value_or(file.farm);
  turbine.name = row.values[kName].value_or(fmt::format("{}", number));
  turbine.radius = file.radius.radius(turbine.tip_height);
  return turbine;
}

/// Returns the fields in the order of TurbineField. A field that was asked for has to be there.
std::vector<SiteField> fields_of(const TurbineFile& file, const LayerFields& layer) {
  const TurbineFile usual;
  const auto field = [](const std::string& name, const std::string& by_default) {
    return SiteField{name, !name.empty() && name != by_default};
  };
  const std::string name = file.name_field.empty() ? name_field_of(layer).value_or(kNameField) : file.name_field;
  return {field(file.hub_height_field, usual.hub_height_field),
          field(file.rotor_diameter_field, usual.rotor_diameter_field),
          field(file.tip_height_field, usual.tip_height_field),
          field(file.farm_field, usual.farm_field),
          SiteField{name, !file.name_field.empty()},
          field(file.status_field, usual.status_field)};
}

}  // namespace

void TurbineSize::complete() {
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

TurbineTable read_turbines(const TurbineFile& file, const std::string& to_crs) {
  SiteQuery query;
  query.path = file.path, query.layer = file.layer, query.where = file.where, query.crs = file.crs;
  const LayerFields layer(query);
  const std::vector<SiteField> fields = fields_of(file, layer);
  TurbineTable table;
  table.path = file.path, table.radius = file.radius;
  const std::vector<SiteRow> rows = read_site_rows(query, fields, to_crs, table.warnings);
  warn_of_likely_sizes(file.path, layer, fields, table.warnings);
  warn_of_zeros(file.path, rows, table.warnings);
  const bool with_status = tells_status(file, rows);
  NoProgress quiet;
  table.sha256 = file_sha256(file.path, quiet);
  for (const SiteRow& row : rows) {
    const std::size_t k = ++table.rows;
    table.features.push_back(row.feature), table.places.push_back(row.place);
    try {
      Turbine turbine = turbine_of(row, k, file);
      turbine.status = status_of_turbine(turbine, row, file, with_status);
      table.turbines.push_back(std::move(turbine));
    } catch (const InputError& error) {
      table.bad.push_back({k, row.feature, row.place, error.what()});
    }
  }
  warn_of_duplicates(file.path, table);
  if (table.rows == 0) throw InputError(none_in(query, "turbine"));
  if (table.turbines.empty()) throw InputError(none_usable(file.path, table.rows, table.bad.front().message));
  require_proposal(file, table.turbines);
  return table;
}

}  // namespace itin::viewshed
