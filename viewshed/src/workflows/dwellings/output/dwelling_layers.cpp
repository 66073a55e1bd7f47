#include "workflows/dwellings/output/dwelling_layers.hpp"

#include <itin/calendar_day.hpp>

#include "workflows/dwellings/flicker_clock.hpp"
#include "workflows/dwellings/output/dwelling_classes.hpp"
#include "workflows/premises/output/vector_styles.hpp"

namespace itin::viewshed {

namespace {

using LayerType = VectorLayer::Type;

VectorLayer::Value whole_number(std::size_t value) {
  return static_cast<std::int64_t>(value);
}

/// Hubs and tips that are seen, the nearest of these turbines, the arcs; empty where nothing is looked at.
void add_view(const std::optional<SightSummary>& view, std::vector<VectorLayer::Value>& values) {
  if (!view) {
    values.resize(values.size() + 4);
    return;
  }
  VectorLayer::Value hubs, arc;
  if (view->hubs) hubs = whole_number(*view->hubs);
  if (view->arc) arc = view->arc->width;
  values.insert(values.end(), {hubs, whole_number(view->tips), arc, view->vertical_deg});
}

void add_view_fields(const std::string& suffix, VectorLayer& layer) {
  layer.fields.insert(layer.fields.end(), {{"hubs_visible" + suffix, LayerType::kWhole},
                                           {"tips_visible" + suffix, LayerType::kWhole},
                                           {"horizontal_extent" + suffix + "_deg", LayerType::kNumber},
                                           {"vertical_angle" + suffix + "_deg", LayerType::kNumber}});
}

VectorLayer layer_of_dwellings(const DwellingsSurvey& survey) {
  VectorLayer layer{"dwellings",
                    VectorLayer::Shape::kPoints,
                    {{"name", LayerType::kText},
                     {"id", LayerType::kText},
                     {"flicker", LayerType::kText},
                     {"flicker_hours", LayerType::kNumber},
                     {"flicker_days", LayerType::kWhole},
                     {"worst_day", LayerType::kText},
                     {"worst_day_minutes", LayerType::kWhole},
                     {"likely_hours", LayerType::kNumber},
                     {"nearest_turbine", LayerType::kWhole},
                     {"nearest_m", LayerType::kNumber}},
                    {},
                    point_style("flicker", kFlickerClasses)};
  add_view_fields("", layer), add_view_fields("_screened", layer);
  for (const Dwelling& d : survey.dwellings) {
    const FlickerSum sum = flicker_sum(survey, d);
    VectorLayer::Value worst, likely;
    if (sum.days > 0) worst = iso_day_text(day_of_year(survey.request.flicker.year.year, sum.worst_day));
    if (sum.likely) likely = *sum.likely / 60;
    std::vector<VectorLayer::Value> values{d.name,
                                           d.id,
                                           std::string(class_of(class_of(sum)).name),
                                           sum.hours(),
                                           whole_number(sum.days),
                                           worst,
                                           whole_number(sum.worst_minutes),
                                           likely,
                                           whole_number(survey.request.turbines.turbines[d.nearest].number),
                                           d.nearest_m};
    add_view(view_of(survey, d, SightSurface::kBare), values);
    add_view(view_of(survey, d, SightSurface::kScreened), values);
    layer.features.push_back({{{d.position.x, d.position.y, d.facades.front().ground_m}}, std::move(values)});
  }
  return layer;
}

VectorLayer layer_of_eyes(const DwellingsSurvey& survey) {
  VectorLayer layer{"facades",
                    VectorLayer::Shape::kPoints,
                    {{"name", LayerType::kText},
                     {"id", LayerType::kText},
                     {"facade", LayerType::kWhole},
                     {"outward_deg", LayerType::kNumber},
                     {"length_m", LayerType::kNumber}},
                    {}};
  add_view_fields("", layer), add_view_fields("_screened", layer);
  for (const Dwelling& d : survey.dwellings) {
    for (std::size_t f = 0; f < d.facades.size(); ++f) {
      const DwellingFacade& facade = d.facades[f];
      VectorLayer::Value outward;
      if (facade.outward_deg) outward = *facade.outward_deg;
      std::vector<VectorLayer::Value> values{d.name, d.id, whole_number(f + 1), outward, facade.length_m};
      add_view(view_of(survey, facade, SightSurface::kBare), values);
      add_view(view_of(survey, facade, SightSurface::kScreened), values);
      layer.features.push_back({{{facade.position.x, facade.position.y, facade.ground_m}}, std::move(values)});
    }
  }
  return layer;
}

VectorLayer layer_of_turbines(const DwellingsSurvey& survey) {
  VectorLayer layer{"turbines",
                    VectorLayer::Shape::kPoints,
                    {{"turbine", LayerType::kWhole},
                     {"name", LayerType::kText},
                     {"farm", LayerType::kText},
                     {"hub_height_m", LayerType::kNumber},
                     {"rotor_diameter_m", LayerType::kNumber},
                     {"tip_height_m", LayerType::kNumber}},
                    {}};
  const auto number = [](const std::optional<double>& v) { return v ? VectorLayer::Value(*v) : VectorLayer::Value(); };
  for (std::size_t t = 0; t < survey.ground_m.size(); ++t) {
    const Turbine& turbine = survey.request.turbines.turbines[t];
    layer.features.push_back({{{turbine.position.x, turbine.position.y, survey.ground_m[t]}},
                              {whole_number(turbine.number), turbine.name, turbine.farm, number(turbine.hub_height),
                               number(turbine.rotor_diameter), turbine.tip_height}});
  }
  return layer;
}

}  // namespace

std::vector<VectorLayer> dwelling_layers(const DwellingsSurvey& survey) {
  return {layer_of_dwellings(survey), layer_of_eyes(survey), layer_of_turbines(survey)};
}

}  // namespace itin::viewshed
