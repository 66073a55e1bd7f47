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
  return [of](const TurbineRow& row) { return if_any(row.turbine, [&](const Turbine&) { return of(row); }); };
}

/// Returns the rows of the turbines of the zone, in its order.
std::vector<TurbineRow> rows_of_turbines(const Zone& zone);

/// Returns the columns that turbines.csv and the layer of turbines have.
std::vector<TableColumn<TurbineRow>> turbine_row_columns(const ZoneStudy& study);

/// Returns a row for each row of the turbines' file, as CSV: what was used, and why a row was not.
std::string turbine_rows(const ZoneStudy& study);

}  // namespace itin::viewshed
