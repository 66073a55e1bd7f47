#include "report/links/budget_columns.hpp"

#include <algorithm>
#include <string>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace itin::profile {

namespace {

/// Adds a column of what `of` has of a budget, an optional or a pointer.
template <class Of>
void add_column(const char* name, Of of, std::vector<LinkColumn>& columns) {
  columns.emplace_back(name, [of](const LinkRow& row) {
    using Cell = decltype(of(*row.budget));
    return row.budget != nullptr ? of(*row.budget) : Cell();
  });
}

std::optional<double> percent_of(const std::optional<Outage>& outage) {
  return outage ? std::optional(outage->percent) : std::nullopt;
}

}  // namespace

void add_budget_columns(const std::vector<LinkRow>& rows, bool with_antennas, std::vector<LinkColumn>& columns) {
  if (std::none_of(rows.begin(), rows.end(), [](const LinkRow& row) { return row.budget != nullptr; })) return;
  const auto add = [&](const char* name, auto of) { add_column(name, of, columns); };
  add("eirp_dbm", [](const LinkBudget& b) { return std::optional(b.eirp_dbm); });
  if (with_antennas) {
    add("off_axis1_db", [](const LinkBudget& b) { return std::optional(b.from_off_axis_db); });
    add("off_axis2_db", [](const LinkBudget& b) { return std::optional(b.to_off_axis_db); });
  }
  add("gases_db", [](const LinkBudget& b) { return b.gases_db; });
  add("level_dbm", [](const LinkBudget& b) { return std::optional(b.level_dbm); });
  add("margin_db", [](const LinkBudget& b) { return b.margin_db; });
  add("rain_exceeded_0_01_db",
      [](const LinkBudget& b) { return b.rain ? std::optional(b.rain->exceeded_db) : std::nullopt; });
  add("rain_outage_percent", [](const LinkBudget& b) { return percent_of(b.rain_outage); });
  add("multipath_outage_percent", [](const LinkBudget& b) { return percent_of(b.multipath_outage); });
  add("availability_percent",
      [](const LinkBudget& b) { return b.availability ? std::optional(b.availability->percent) : std::nullopt; });
  add("outage_minutes", [](const LinkBudget& b) {
    return b.availability ? std::optional(b.availability->outage_minutes) : std::nullopt;
  });
  add("left_out", [](const LinkBudget& b) { return fmt::format("{}", fmt::join(b.left_out, "; ")); });
}

}  // namespace itin::profile
