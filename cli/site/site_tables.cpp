#include "site/site_tables.hpp"

#include <iterator>

#include <fmt/format.h>

#include <itin/csv_cell.hpp>
#include <itin/output_file.hpp>
#include <itin/vector_export.hpp>

#include "site/site_link_outputs.hpp"

namespace itin::cli {

namespace {

std::string sites_csv(const SiteResult& r) {
  std::string text =
      "order,id,x,y,height_m,ground_m,cost,gain,cumulative,coverage,first_certain,first_possible,stands_on_m\n";
  const auto out = std::back_inserter(text);
  for (std::size_t i = 0; i < r.choice.chosen.size(); ++i) {
    const viewshed::ChosenSite& site = r.choice.chosen[i];
    const viewshed::SitePosition& place = r.place_of(site);
    const CoverageSummary now = r.summary(r.coverage.bounds(site.option)),
                          first = r.summary(r.coverage.first_bounds(site.option));
    fmt::format_to(out, "{},{},{},{},{},{:.3f},{},{},{},{},{},{},{:.3f}\n", i + 1, csv_cell(place.name),
                   place.position.x, place.position.y, place.height, r.ground_m[i], r.inputs.options[site.option].cost,
                   r.in_metric(site.gain), r.in_metric(site.cumulative), now.certain, first.certain, first.possible,
                   place.ground);
  }
  return text;
}

std::string candidates_table(const SiteResult& r) {
  std::string text =
      "id,x,y,height_m,cost,looked_at,first_certain,first_possible,certain,possible,proposed_as,outcome\n";
  const auto out = std::back_inserter(text);
  for (std::size_t i = 0; i < r.inputs.options.size(); ++i) {
    const viewshed::SitePosition& place = r.inputs.positions[i];
    const CoverageSummary now = r.summary(r.coverage.bounds(i)), first = r.summary(r.coverage.first_bounds(i));
    fmt::format_to(out, "{},{},{},{},{},{},{},{},{},{},{},{}\n", csv_cell(place.name), place.position.x,
                   place.position.y, place.height, r.inputs.options[i].cost,
                   csv_cell(r.coverage.stage_name(r.coverage.stage(i))), first.certain, first.possible, now.certain,
                   now.possible, r.candidate(i).why, csv_cell(r.reason(i)));
  }
  return text;
}

using Type = VectorLayer::Type;

VectorLayer sites_layer(const SiteResult& r) {
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
    const viewshed::ChosenSite& site = r.choice.chosen[i];
    const viewshed::SitePosition& place = r.place_of(site);
    layer.features.push_back(
        {{{place.position.x, place.position.y, place.ground}},
         {static_cast<std::int64_t>(i + 1), place.name, place.height, r.inputs.options[site.option].cost,
          r.in_metric(site.gain), r.in_metric(site.cumulative)}});
  }
  return layer;
}

VectorLayer candidates_layer(const SiteResult& r) {
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
    const viewshed::SitePosition& place = r.inputs.positions[i];
    const CoverageSummary now = r.summary(r.coverage.bounds(i));
    layer.features.push_back({{{place.position.x, place.position.y, place.ground}},
                              {place.name, place.height, r.inputs.options[i].cost,
                               r.coverage.stage_name(r.coverage.stage(i)), now.certain, now.possible, r.reason(i)}});
  }
  return layer;
}

/// Returns the turbines as `itin ztv --turbines` reads them.
std::string turbines_csv(const SiteResult& r) {
  const PlacementOptions& placement = r.options.placement;
  std::string text = "name,x,y,hub_height,rotor_diameter,tip_height,farm\n";
  for (const viewshed::ChosenSite& site : r.choice.chosen) {
    const viewshed::SitePosition& place = r.place_of(site);
    text += fmt::format("{},{},{},{},{},{},{}\n", csv_cell(place.name), place.position.x, place.position.y,
                        placement.hub_height(), placement.rotor_diameter(), placement.tip_height(),
                        csv_cell(placement.farm));
  }
  return text;
}

VectorLayer turbines_layer(const SiteResult& r) {
  const PlacementOptions& placement = r.options.placement;
  VectorLayer layer{"turbines",
                    VectorLayer::Shape::kPoints,
                    {{"name", Type::kText},
                     {"hub_height", Type::kNumber},
                     {"rotor_diameter", Type::kNumber},
                     {"tip_height", Type::kNumber},
                     {"farm", Type::kText}},
                    {}};
  for (const viewshed::ChosenSite& site : r.choice.chosen) {
    const viewshed::SitePosition& place = r.place_of(site);
    layer.features.push_back(
        {{{place.position.x, place.position.y, place.ground}},
         {place.name, placement.hub_height(), placement.rotor_diameter(), placement.tip_height(), placement.farm}});
  }
  return layer;
}

}  // namespace

void write_site_tables(const SiteResult& result, bool overwrite) {
  write_file(result.options.path("sites.csv"), sites_csv(result), overwrite);
  write_file(result.options.path("candidates.csv"), candidates_table(result), overwrite);
  if (result.options.placement.given()) {
    write_file(result.options.path("turbines.csv"), turbines_csv(result), overwrite);
  } else {
    write_file(result.options.path("links.csv"), links_csv(result), overwrite);
    if (result.options.hub) write_file(result.options.path("routes.csv"), routes_csv(result), overwrite);
  }
}

void write_site_layers(const SiteResult& result, const std::string& crs_wkt, bool overwrite) {
  std::vector<VectorLayer> layers{sites_layer(result), candidates_layer(result)};
  if (result.options.placement.given()) {
    write_geopackage(result.options.path("turbines.gpkg"), crs_wkt, {turbines_layer(result)}, overwrite);
  } else {
    layers.push_back(links_layer(result));
  }
  write_geopackage(result.options.path("sites.gpkg"), crs_wkt, layers, overwrite);
}

}  // namespace itin::cli
