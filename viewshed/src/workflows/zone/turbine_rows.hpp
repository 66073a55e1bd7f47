// The table of the turbines.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <itin/table_columns.hpp>
#include <viewshed/zone_study.hpp>

namespace itin::viewshed {

/// A row of the turbines' file.
struct TurbineRow {
  std::size_t number = 0;  ///< from 1
  std::size_t index = 0;   ///< the place of the turbine among those of the zone
  const Turbine* turbine = nullptr;
  const BadRow* bad = nullptr;  ///< why the row was not used; null: it was
};

/// Returns a cell that is empty in rows that were not used; `of` takes a row that was.
template <class Of>
auto of_turbine(Of of) {
  return [of](const TurbineRow& row) { return row.turbine != nullptr ? std::optional(of(row)) : std::nullopt; };
}

/// Returns a row for each row of the turbines' file, as CSV: what was used, and why a row was not.
std::string turbine_rows(const ZoneStudy& study);

/// Returns "proposed", "consented" or "existing"; empty where the status is not known.
const char* planning_word(const Turbine& turbine);

}  // namespace itin::viewshed
