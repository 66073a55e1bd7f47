#include "workflows/zone/turbine_rows.hpp"

#include <viewshed/zone_files.hpp>

#include "workflows/zone/study_radio.hpp"

namespace itin::viewshed {

namespace {

std::vector<TurbineRow> rows_of_file(const ZoneStudy& study) {
  std::vector<TurbineRow> rows(study.request.turbines.rows);
  for (const TurbineRow& row : rows_of_turbines(study.zone)) rows[row.number - 1] = row;
  for (const BadRow& bad : study.request.turbines.bad) rows[bad.number - 1] = {bad.number, 0, nullptr, &bad};
  std::erase_if(rows, [](const TurbineRow& row) { return row.number == 0; });
  return rows;
}

}  // namespace

std::vector<TurbineRow> rows_of_turbines(const Zone& zone) {
  std::vector<TurbineRow> rows;
  for (std::size_t k = 0; k < zone.request.turbines.size(); ++k) {
    const Turbine& turbine = zone.request.turbines[k];
    rows.push_back({turbine.number, k, &turbine, nullptr});
  }
  return rows;
}

std::vector<TableColumn<TurbineRow>> turbine_row_columns(const ZoneStudy& study) {
  std::vector<TableColumn<TurbineRow>> columns;
  const auto of_row = [](auto of) { return [of](const TurbineRow& row) { return if_any(row.turbine, of); }; };
  const auto add = [&](const char* name, auto of, int formats, const char* number = "{}") {
    columns.emplace_back(name, of_row(of), formats, number);
  };
  columns.emplace_back("number", &TurbineRow::number);
  // The file's own number for a row. There is none where the turbines are not from a file.
  columns.emplace_back(
      "feature",
      [&features = study.request.turbines.features](const TurbineRow& row) {
        return row.number <= features.size() ? std::optional(features[row.number - 1]) : std::nullopt;
      },
      kInCsv);
  add_turbine_names(columns, of_row, kInLayer);
  add(
      "x", [](const Turbine& t) { return t.position.x; }, kInCsv, "{:.3f}");
  add(
      "y", [](const Turbine& t) { return t.position.y; }, kInCsv, "{:.3f}");
  columns.emplace_back("ground_m",
                       of_turbine([&study](const TurbineRow& row) { return study.zone.ground_m[row.index]; }), kInCsv,
                       "{:.2f}");
  add_turbine_sizes(columns, of_row);
  add(
      "radius_km", [](const Turbine& t) { return t.radius / 1000; }, kInCsv | kInLayer, "{:g}");
  columns.emplace_back(
      "status", [](const TurbineRow& row) { return row.bad == nullptr ? "used" : "not used"; }, kInCsv);
  columns.emplace_back(
      "message", [](const TurbineRow& row) { return row.bad == nullptr ? "" : row.bad->message; }, kInCsv);
  add_radio_columns(study, columns);
  if (has_proposal(study.zone.request)) add("planning_status", planning_status, kInCsv);
  return columns;
}

std::string turbine_rows(const ZoneStudy& study) {
  return csv_of(turbine_row_columns(study), rows_of_file(study));
}

}  // namespace itin::viewshed
