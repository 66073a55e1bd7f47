#include "workflows/zone/turbine_rows.hpp"

#include "workflows/zone/study_radio.hpp"

namespace itin::viewshed {

namespace {

std::vector<TurbineRow> rows_of_file(const ZoneStudy& study) {
  std::vector<TurbineRow> rows(study.request.turbines.rows);
  const std::vector<Turbine>& turbines = study.zone.request.turbines;
  for (std::size_t k = 0; k < turbines.size(); ++k)
    rows[turbines[k].number - 1] = {turbines[k].number, k, &turbines[k], nullptr};
  for (const BadRow& bad : study.request.turbines.bad) rows[bad.number - 1] = {bad.number, 0, nullptr, &bad};
  std::erase_if(rows, [](const TurbineRow& row) { return row.number == 0; });
  return rows;
}

std::vector<TableColumn<TurbineRow>> turbine_row_columns(const ZoneStudy& study) {
  std::vector<TableColumn<TurbineRow>> columns;
  const auto add = [&](const char* name, auto of, const char* number = "{}") {
    columns.emplace_back(name, of_turbine([of](const TurbineRow& row) { return of(*row.turbine); }), kInCsv, number);
  };
  columns.emplace_back("number", [](const TurbineRow& row) { return row.number; });
  // The file's own number for a row. There is none where the turbines are not from a file.
  columns.emplace_back("feature", [&features = study.request.turbines.features](const TurbineRow& row) {
    return row.number <= features.size() ? std::optional(features[row.number - 1]) : std::nullopt;
  });
  add("name", [](const Turbine& t) { return t.name; });
  add("farm", [](const Turbine& t) { return t.farm; });
  add(
      "x", [](const Turbine& t) { return t.position.x; }, "{:.3f}");
  add(
      "y", [](const Turbine& t) { return t.position.y; }, "{:.3f}");
  columns.emplace_back("ground_m",
                       of_turbine([&study](const TurbineRow& row) { return study.zone.ground_m[row.index]; }), kInCsv,
                       "{:.2f}");
  add(
      "hub_height_m", [](const Turbine& t) { return t.hub_height; }, "{:.2f}");
  add(
      "rotor_diameter_m", [](const Turbine& t) { return t.rotor_diameter; }, "{:.2f}");
  add(
      "tip_height_m", [](const Turbine& t) { return t.tip_height; }, "{:g}");
  add(
      "radius_km", [](const Turbine& t) { return t.radius / 1000; }, "{:g}");
  columns.emplace_back("status", [](const TurbineRow& row) { return row.bad == nullptr ? "used" : "not used"; });
  columns.emplace_back("message", [](const TurbineRow& row) { return row.bad == nullptr ? "" : row.bad->message; });
  add_radio_columns(study, columns);
  if (has_proposal(study.zone.request)) add("planning_status", planning_word);
  return columns;
}

}  // namespace

const char* planning_word(const Turbine& turbine) {
  constexpr const char* kWords[] = {"proposed", "consented", "existing"};
  return turbine.status ? kWords[static_cast<std::size_t>(*turbine.status)] : "";
}

std::string turbine_rows(const ZoneStudy& study) {
  return csv_of(turbine_row_columns(study), rows_of_file(study));
}

}  // namespace itin::viewshed
