#include "workflows/siting/output/site_tables.hpp"

#include <iterator>

#include <fmt/format.h>

#include <itin/csv_cell.hpp>

namespace itin::viewshed {

using Type = VectorLayer::Type;

std::string sites_csv(const SitePlan& r) {
  std::string text =
      "order,id,x,y,height_m,ground_m,cost,gain,cumulative,coverage,first_certain,first_possible,stands_on_m\n";
  const auto out = std::back_inserter(text);
  for (std::size_t i = 0; i < r.choice.chosen.size(); ++i) {
    const ChosenSite& site = r.choice.chosen[i];
    const SitePosition& place = r.place_of(site);
    const auto& [first, last, exact, stage, looked_at] = r.surveys[site.option];
    fmt::format_to(out, "{},{},{},{},{},{:.3f},{},{},{},{},{},{},{:.3f}\n", i + 1, csv_cell(place.name),
                   place.position.x, place.position.y, place.height, r.ground_m[i], r.inputs.options[site.option].cost,
                   r.in_metric(site.gain), r.in_metric(site.cumulative), last.certain, first.certain, first.possible,
                   place.ground);
  }
  return text;
}

std::string candidates_csv(const SitePlan& r) {
  std::string text =
      "id,x,y,height_m,cost,looked_at,first_certain,first_possible,certain,possible,proposed_as,outcome\n";
  const auto out = std::back_inserter(text);
  for (std::size_t i = 0; i < r.inputs.options.size(); ++i) {
    const SitePosition& place = r.inputs.positions[i];
    const auto& [first, last, exact, stage, looked_at] = r.surveys[i];
    fmt::format_to(out, "{},{},{},{},{},{},{},{},{},{},{},{}\n", csv_cell(place.name), place.position.x,
                   place.position.y, place.height, r.inputs.options[i].cost, csv_cell(looked_at), first.certain,
                   first.possible, last.certain, last.possible, r.candidate(i).proposed_as, csv_cell(r.reason(i)));
  }
  return text;
}

VectorLayer sites_layer(const SitePlan& r) {
  VectorLayer layer{"sites",
                    VectorLayer::Shape::kPoints,
                    {{"rank", Type::kWhole},
                     {"id", Type::kText},
                     {"height_m", Type::kNumber},
                     {"cost", Type::kNumber},
                     {"gain", Type::kNumber},
                     {"cumulative", Type::kNumber}},
                    {}};
  for (std::size_t i = 0; i < r.choice.chosen.size(); ++i) {
    const ChosenSite& site = r.choice.chosen[i];
    const SitePosition& place = r.place_of(site);
    layer.features.push_back(
        {{{place.position.x, place.position.y, place.ground}},
         {static_cast<std::int64_t>(i + 1), place.name, place.height, r.inputs.options[site.option].cost,
          r.in_metric(site.gain), r.in_metric(site.cumulative)}});
  }
  return layer;
}

VectorLayer candidates_layer(const SitePlan& r) {
  VectorLayer layer{"candidates",
                    VectorLayer::Shape::kPoints,
                    {{"id", Type::kText},
                     {"height_m", Type::kNumber},
                     {"cost", Type::kNumber},
                     {"looked_at", Type::kText},
                     {"certain", Type::kNumber},
                     {"possible", Type::kNumber},
                     {"outcome", Type::kText}},
                    {}};
  for (std::size_t i = 0; i < r.inputs.options.size(); ++i) {
    const SitePosition& place = r.inputs.positions[i];
    const auto& [first, last, exact, stage, looked_at] = r.surveys[i];
    layer.features.push_back(
        {{{place.position.x, place.position.y, place.ground}},
         {place.name, place.height, r.inputs.options[i].cost, looked_at, last.certain, last.possible, r.reason(i)}});
  }
  return layer;
}

std::string turbines_csv(const SitePlan& r) {
  const TurbinePlacement& placement = *r.request.turbines;
  std::string text = "name,x,y,hub_height,rotor_diameter,tip_height,farm\n";
  for (const ChosenSite& site : r.choice.chosen) {
    const SitePosition& place = r.place_of(site);
    text += fmt::format("{},{},{},{},{},{},{}\n", csv_cell(place.name), place.position.x, place.position.y,
                        placement.hub_height, placement.rotor_diameter, placement.tip_height, csv_cell(placement.farm));
  }
  return text;
}

VectorLayer turbines_layer(const SitePlan& r) {
  const TurbinePlacement& placement = *r.request.turbines;
  VectorLayer layer{"turbines",
                    VectorLayer::Shape::kPoints,
                    {{"name", Type::kText},
                     {"hub_height", Type::kNumber},
                     {"rotor_diameter", Type::kNumber},
                     {"tip_height", Type::kNumber},
                     {"farm", Type::kText}},
                    {}};
  for (const ChosenSite& site : r.choice.chosen) {
    const SitePosition& place = r.place_of(site);
    layer.features.push_back(
        {{{place.position.x, place.position.y, place.ground}},
         {place.name, placement.hub_height, placement.rotor_diameter, placement.tip_height, placement.farm}});
  }
  return layer;
}

}  // namespace itin::viewshed
