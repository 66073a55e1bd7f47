#include "workflows/zone/turbine_rows.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <itin/csv_cell.hpp>

#include "workflows/zone/study_radio.hpp"

namespace itin::viewshed {

namespace {

/// Returns the file's own number for a row; empty where the turbines are not from a file.
std::string feature_cell(const TurbineTable& table, std::size_t number) {
  return number <= table.features.size() ? fmt::format("{}", table.features[number - 1]) : "";
}

std::string used_row(const ZoneStudy& study, std::size_t k) {
  const Turbine& t = study.zone.request.turbines[k];
  const std::string planning = has_proposal(study.zone.request) ? fmt::format(",{}", planning_word(t)) : "";
  return fmt::format("{},{},{},{},{:.3f},{:.3f},{:.2f},{},{},{:g},{:g},used,{}{}\n", t.number,
                     feature_cell(study.request.turbines, t.number), csv_cell(t.name), csv_cell(t.farm), t.position.x,
                     t.position.y, study.zone.ground_m[k], csv_cell(t.hub_height, 2), csv_cell(t.rotor_diameter, 2),
                     t.tip_height, t.radius / 1000, radio_cells(study, k), planning);
}

}  // namespace

const char* planning_word(const Turbine& turbine) {
  constexpr const char* kWords[] = {"proposed", "consented", "existing"};
  return turbine.status ? kWords[static_cast<std::size_t>(*turbine.status)] : "";
}

std::string turbine_rows(const ZoneStudy& study) {
  const TurbineTable& table = study.request.turbines;
  std::vector<std::string> rows(table.rows);
  for (std::size_t k = 0; k < study.zone.request.turbines.size(); ++k)
    rows[study.zone.request.turbines[k].number - 1] = used_row(study, k);
  const std::string names = radio_columns(study) + (has_proposal(study.zone.request) ? ",planning_status" : ""),
                    none(static_cast<std::size_t>(std::count(names.begin(), names.end(), ',')), ',');
  for (const BadRow& bad : table.bad)
    rows[bad.number - 1] = fmt::format("{},{},,,,,,,,,,not used,{}{}\n", bad.number, feature_cell(table, bad.number),
                                       csv_cell(bad.message), none);
  return "number,feature,name,farm,x,y,ground_m,hub_height_m,rotor_diameter_m,tip_height_m,radius_km,status,message" +
         names + "\n" + fmt::format("{}", fmt::join(rows, ""));
}

}  // namespace itin::viewshed
