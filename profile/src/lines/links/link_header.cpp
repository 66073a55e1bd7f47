#include "lines/links/link_header.hpp"

#include <algorithm>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <itin/error.hpp>
#include <itin/position_columns.hpp>

namespace itin::profile {

namespace {

struct ExtraName {
  const char* name;
  LinkExtra extra;
};
constexpr ExtraName kExtraNames[] = {
    {"name1", LinkExtra::kName1},
    {"site1", LinkExtra::kName1},
    {"name2", LinkExtra::kName2},
    {"site2", LinkExtra::kName2},
    {"frequency", LinkExtra::kFrequency},
    {"frequency_ghz", LinkExtra::kFrequency},
    {"freq", LinkExtra::kFrequency},
    {"freq_ghz", LinkExtra::kFrequency},
    {"frequency_mhz", LinkExtra::kMegahertz},
    {"freq_mhz", LinkExtra::kMegahertz},
    {"pol", LinkExtra::kPolarisation},
    {"polarisation", LinkExtra::kPolarisation},
    {"polarization", LinkExtra::kPolarisation},
    {"criteria", LinkExtra::kCriteria},
    {"criterion", LinkExtra::kCriteria},
};

struct BudgetName {
  const char* name;
  std::optional<double> BudgetQuery::*value;
};
constexpr BudgetName kBudgetNames[] = {
    {"power_dbm", &BudgetQuery::power_dbm},
    {"tx_power_dbm", &BudgetQuery::power_dbm},
    {"eirp_dbm", &BudgetQuery::eirp_dbm},
    {"gain1_dbi", &BudgetQuery::from_gain_dbi},
    {"gain1", &BudgetQuery::from_gain_dbi},
    {"gain2_dbi", &BudgetQuery::to_gain_dbi},
    {"gain2", &BudgetQuery::to_gain_dbi},
    {"feeder_loss1_db", &BudgetQuery::from_feeder_db},
    {"feeder_loss2_db", &BudgetQuery::to_feeder_db},
    {"sensitivity_dbm", &BudgetQuery::sensitivity_dbm},
    {"threshold_dbm", &BudgetQuery::sensitivity_dbm},
    {"rain_rate_mm_h", &BudgetQuery::rain_rate_mm_h},
    {"geoclimatic_factor", &BudgetQuery::geoclimatic_factor},
    {"refractivity_gradient", &BudgetQuery::refractivity_gradient},
};

/// The entry of such a list that a column's name stands for; null where it is none of them.
template <class Named, std::size_t count>
const Named* entry_of(const std::string& column, const Named (&list)[count]) {
  const auto found =
      std::find_if(list, list + count, [&](const Named& entry) { return same_column_name(column, entry.name); });
  return found == list + count ? nullptr : found;
}

/// The column of an antenna's height at an end, "1" or "2".
std::optional<std::size_t> height_column(const std::vector<std::string>& names, const std::string& end) {
  for (const char* name : {"h", "height", "antenna_height", "ant_height", "mast_height", "agl", "hagl", "height_agl"})
    for (const std::string& whole : {name + end, name + ("_m" + end)})
      if (const auto found = column_named(names, whole)) return found;
  return std::nullopt;
}

std::optional<std::size_t> id_column(const std::vector<std::string>& names) {
  for (const char* name : {"id", "name", "link"})
    if (const auto found = column_named(names, name)) return found;
  return std::nullopt;
}

/// Sorts the columns that hold no part of a link's ends.
void add_further(const std::vector<std::string>& names, LinkHeader& header) {
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names[i].empty() || std::find(header.of.begin(), header.of.end(), i) != header.of.end()) continue;
    if (const ExtraName* extra = entry_of(names[i], kExtraNames)) {
      header.extras.emplace_back(i, extra->extra);
    } else if (const BudgetName* budget = entry_of(names[i], kBudgetNames)) {
      header.budget.emplace_back(i, budget->value);
    } else {
      header.others.push_back(i);
    }
  }
}

/// Tells which columns may be meant by names that are missing.
std::string likely_columns(const std::vector<std::string>& names) {
  std::vector<std::string> likely;
  for (const std::string& name : names)
    if (may_hold_heights(name)) likely.push_back(fmt::format("'{}'", name));
  return likely.empty() ? "" : fmt::format("; {} may be meant by h1 or h2", fmt::join(likely, ", "));
}

/// Warns of a header whose names are all unknown.
std::string taken_by_order(const std::vector<std::string>& names, const std::string& path) {
  std::vector<std::string> taken;
  for (std::size_t i = 0; i < std::min(names.size(), kLinkColumns); ++i)
    taken.push_back(fmt::format("'{}' as {}", names[i], kLinkNames[i]));
  return fmt::format("{}: its header is not understood; columns are taken by their order: {}", path,
                     fmt::join(taken, ", "));
}

/// The number of columns, those at the end without a name left out.
std::size_t named_width(const std::vector<std::string>& names) {
  std::size_t width = names.size();
  while (width > 0 && names[width - 1].empty()) --width;
  return width;
}

}  // namespace

LinkHeader link_header(const std::vector<std::string>& names, const std::string& path) {
  const auto from = position_columns(names, "1"), to = position_columns(names, "2");
  LinkHeader header;
  header.geographic = from && from->geographic;
  if (header.geographic != (to && to->geographic))
    throw InputError(path + ": its header names longitude and latitude for one end only; give both ends alike");
  const auto h1 = height_column(names, "1"), h2 = height_column(names, "2");
  const auto position1 = written_column(names, "1"), position2 = written_column(names, "2");
  header.written = !from && !to && position1 && position2;
  std::vector<const char*> missing;
  if (!from && !header.written) missing.insert(missing.end(), {"x1", "y1"});
  if (!h1) missing.push_back("h1");
  if (!to && !header.written) missing.insert(missing.end(), {"x2", "y2"});
  if (!h2) missing.push_back("h2");
  header.named = from || to || position1 || position2 || h1 || h2;
  if (header.named && !missing.empty())
    throw InputError(
        fmt::format("{}: its header has no column {}; name the columns id,x1,y1,h1,x2,y2,h2, in any order{}", path,
                    fmt::join(missing, ", "), likely_columns(names)));
  const auto id = id_column(names);
  header.numbered = header.named && !id;
  header.width = header.named ? named_width(names) : std::max(named_width(names), kLinkColumns);
  const std::size_t first = id.value_or(h1.value_or(0));  // h1 a second time, so that no other column is taken
  if (header.written) header.of = {first, *position1, *position1, *h1, *position2, *position2, *h2};
  if (from && to) header.of = {first, from->x, from->y, *h1, to->x, to->y, *h2};
  // Names that serve for points only, as in id,e,n,h,e,n,h, are the usual order.
  const bool usual = names.size() >= kLinkColumns && column_named(names, "h") && position_columns(names);
  if (!header.named && !names.empty() && !usual) header.warnings.push_back(taken_by_order(names, path));
  add_further(names, header);
  return header;
}

}  // namespace itin::profile
