#include "workflows/zone/output/study_layers.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include <itin/feature_style.hpp>
#include <itin/table_columns.hpp>
#include <viewshed/link_exclusion.hpp>
#include <viewshed/zone_files.hpp>

#include "turbines/output/count_regions.hpp"
#include "workflows/zone/sight_summary.hpp"
#include "workflows/zone/study_radio.hpp"
#include "workflows/zone/turbine_rows.hpp"

namespace itin::viewshed {

namespace {

std::vector<Point3> at_zero(const std::vector<Point2>& line) {
  std::vector<Point3> points;
  for (const Point2& p : line) points.push_back({p.x, p.y, 0});
  return points;
}

/// Returns a layer of lines in their colour, with the field `what`, and `label` for the label. Legends have `text`.
VectorLayer layer_of_lines(const char* name, const std::string& text, const profile::SheetLines& lines,
                           double width_mm) {
  const std::array<FeatureClass, 1> all{{{name, text.c_str(), lines.colour}}};
  const std::vector<TableColumn<profile::SheetLine>> columns{
      {"what", [name](const profile::SheetLine&) { return name; }}, {"label", &profile::SheetLine::label}};
  return layer_of(
      name, VectorLayer::Shape::kLines, columns, lines.lines,
      [](const profile::SheetLine& line) { return at_zero(line.points); }, line_style("what", all, width_mm));
}

/// The turbines in colours by their status where there is a proposal, else by their farms.
VectorLayer layer_of_turbines(const ZoneStudy& study) {
  const Zone& zone = study.zone;
  const auto place = [&](const TurbineRow& row) {
    return std::vector<Point3>{{row.turbine->position.x, row.turbine->position.y, zone.ground_m[row.index]}};
  };
  return layer_of("turbines", VectorLayer::Shape::kPoints, turbine_row_columns(study), rows_of_turbines(zone), place,
                  turbine_style(zone.request.turbines));
}

VectorLayer layer_of_viewpoints(const ZoneStudy& study) {
  constexpr std::array<FeatureClass, 1> kAll{{{"viewpoint", "Viewpoint", {20, 60, 140}}}};
  struct Row {
    const Viewpoint& viewpoint;
    SightSummary seen;
  };
  const std::vector<TableColumn<Row>> columns{{"what", [](const Row&) { return "viewpoint"; }},
                                              {"number", [](const Row& row) { return row.viewpoint.number; }},
                                              {"name", [](const Row& row) { return row.viewpoint.name; }},
                                              {"height_m", [](const Row& row) { return row.viewpoint.height; }},
                                              {"tips_seen", [](const Row& row) { return row.seen.tips; }},
                                              {"nearest_m", [](const Row& row) { return row.seen.nearest_m; }}};
  std::vector<Row> rows;
  for (const StudiedViewpoint& studied : study.viewpoints)
    rows.push_back({studied.viewpoint, seen_of(study.zone, studied.bare, all_turbines(study.zone))});
  const auto place = [](const Row& row) {
    const Viewpoint& v = row.viewpoint;
    return std::vector<Point3>{{v.position.x, v.position.y, v.ground}};
  };
  return layer_of("viewpoints", VectorLayer::Shape::kPoints, columns, rows, place, point_style("what", kAll));
}

/// The outline of the area that rotors must stay out of, in plan: the second Fresnel zone and a rotor's radius about
/// it.
std::vector<Point2> exclusion_outline(const RadioLink& link, const LinkStudy& study) {
  constexpr int kSteps = 64, kCapSteps = 12;
  const double dx = link.to.x - link.from.x, dy = link.to.y - link.from.y, length = std::hypot(dx, dy);
  if (length == 0) return {};
  const Point2 along{dx / length, dy / length};
  std::vector<Point2> outline;
  const auto add = [&](double distance, double forward, double left) {
    outline.push_back({link.from.x + (distance + forward) * along.x - left * along.y,
                       link.from.y + (distance + forward) * along.y + left * along.x});
  };
  for (const bool back : {false, true}) {
    const double side = back ? -1 : 1;
    for (int i = 0; i <= kSteps; ++i) {
      const double at = length * (back ? kSteps - i : i) / kSteps;
      const double radius = second_fresnel_radius_m(at, length - at, study.frequency_ghz) + study.rotor_radius_m;
      add(at, 0, side * radius);
    }
    for (int i = 1; i < kCapSteps; ++i) {
      const double angle = std::numbers::pi * i / kCapSteps;
      add(back ? 0 : length, side * study.rotor_radius_m * std::sin(angle),
          side * study.rotor_radius_m * std::cos(angle));
    }
  }
  outline.push_back(outline.front());
  return outline;
}

profile::SheetLines exclusion_outlines(const ZoneStudy& study, const Rgba& colour) {
  const LinkStudy radio = exclusion_of(study);
  profile::SheetLines outlines{{}, colour};
  for (const RadioLink& link : radio.links)
    if (std::vector<Point2> outline = exclusion_outline(link, radio); !outline.empty())
      outlines.lines.push_back({std::move(outline), link.id});
  return outlines;
}

}  // namespace

std::vector<VectorLayer> study_layers(const ZoneStudy& study, const StudyLines& lines) {
  std::vector<VectorLayer> layers{layer_of_turbines(study),
                                  layer_of_viewpoints(study),
                                  layer_of_lines("routes", "Route", lines.routes, 0.6),
                                  layer_of_lines("radio_links", "Radio link", lines.radio_links, 0.4),
                                  layer_of_lines("exclusion", "Area that rotors must stay out of",
                                                 exclusion_outlines(study, lines.radio_links.colour), 0.2),
                                  layer_of_lines("rings", lines.rings_text, lines.rings, 0.2),
                                  layer_of_lines("study_area", "Study area", lines.study_area, 0.6)};
  std::erase_if(layers, [](const VectorLayer& layer) { return layer.features.empty(); });
  return layers;
}

std::vector<RegionLayer> season_layers(const Zone& zone) {
  std::vector<RegionLayer> layers;
  if (!zone.seasons) return layers;
  for (const auto& [season, counts] :
       {std::pair("summer", &zone.seasons->summer), std::pair("winter", &zone.seasons->winter)}) {
    layers.push_back(band_layer(std::string("tips_") + season, zone, {zone, *counts, TurbinePart::kTip}));
    if (known_hubs(zone) > 0)
      layers.push_back(band_layer(std::string("hubs_") + season, zone, {zone, *counts, TurbinePart::kHub}));
  }
  return layers;
}

}  // namespace itin::viewshed
