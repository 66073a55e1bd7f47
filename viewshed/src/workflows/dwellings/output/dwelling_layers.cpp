#include "workflows/dwellings/output/dwelling_layers.hpp"

#include <itin/table_columns.hpp>
#include <viewshed/zone_files.hpp>

#include "workflows/dwellings/output/dwelling_tables.hpp"

namespace itin::viewshed {

namespace {

VectorLayer turbines_of_survey(const DwellingsSurvey& survey) {
  const auto of_turbine = [](auto of) { return of; };
  std::vector<TableColumn<Turbine>> columns{{"turbine", &Turbine::number}};
  add_turbine_names(columns, of_turbine, kInLayer);
  add_turbine_sizes(columns, of_turbine);
  const std::vector<Turbine>& turbines = survey.request.turbines.turbines;
  const auto place = [&](const Turbine& t) {
    const auto number = static_cast<std::size_t>(&t - turbines.data());
    return std::vector<Point3>{{t.position.x, t.position.y, survey.ground_m[number]}};
  };
  return layer_of("turbines", VectorLayer::Shape::kPoints, columns, turbines, place, turbine_style(turbines));
}

}  // namespace

std::vector<VectorLayer> dwelling_layers(const DwellingsSurvey& survey) {
  return {layer_of_dwellings(survey), layer_of_facades(survey), turbines_of_survey(survey)};
}

}  // namespace itin::viewshed
