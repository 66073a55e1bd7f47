#include "workflows/zone/study_layers.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include <viewshed/link_exclusion.hpp>
#include <viewshed/zone_files.hpp>

#include "files/vector_styles.hpp"
#include "turbines/value_bands.hpp"
#include "workflows/zone/sight_summary.hpp"
#include "workflows/zone/study_radio.hpp"
#include "workflows/zone/study_sheets.hpp"
#include "workflows/zone/turbine_rows.hpp"

namespace itin::viewshed {

namespace {

using Type = VectorLayer::Type;

VectorLayer::Value optional_number(const std::optional<double>& number) {
  return number ? VectorLayer::Value(*number) : VectorLayer::Value();
}

std::vector<Point3> at_zero(const std::vector<Point2>& line) {
  std::vector<Point3> points;
  for (const Point2& p : line) points.push_back({p.x, p.y, 0});
  return points;
}

/// Returns a layer of lines that are all drawn in one colour, with the field `what`, and `label` for the label.
VectorLayer layer_of_lines(const char* name, const std::vector<profile::SheetLine>& lines, const Rgba& colour,
                           double width_mm) {
  const std::array<ServiceClass, 1> all{{{name, name, colour}}};
  VectorLayer layer{name,
                    VectorLayer::Shape::kLines,
                    {{"what", Type::kText}, {"label", Type::kText}},
                    {},
                    line_style("what", all, width_mm)};
  for (const profile::SheetLine& line : lines)
    layer.features.push_back({at_zero(line.points), {std::string(name), line.label}});
  return layer;
}

/// The turbines in colours by their status where there is a proposal, else by their farms.
VectorLayer layer_of_turbines(const Zone& zone) {
  VectorLayer layer{"turbines",
                    VectorLayer::Shape::kPoints,
                    {{"number", Type::kWhole},
                     {"name", Type::kText},
                     {"farm", Type::kText},
                     {"planning_status", Type::kText},
                     {"hub_height_m", Type::kNumber},
                     {"rotor_diameter_m", Type::kNumber},
                     {"tip_height_m", Type::kNumber},
                     {"radius_km", Type::kNumber}},
                    {}};
  for (std::size_t k = 0; k < zone.request.turbines.size(); ++k) {
    const Turbine& t = zone.request.turbines[k];
    layer.features.push_back(
        {{{t.position.x, t.position.y, zone.ground_m[k]}},
         {static_cast<std::int64_t>(t.number), t.name, t.farm, std::string(planning_word(t)),
          optional_number(t.hub_height), optional_number(t.rotor_diameter), t.tip_height, t.radius / 1000}});
  }
  constexpr std::array<ServiceClass, 3> kStatus{{{"proposed", "Proposed", {213, 94, 0}},
                                                 {"consented", "Consented", {204, 121, 167}},
                                                 {"existing", "Existing", {60, 60, 60}}}};
  if (has_proposal(zone.request)) {
    layer.style = point_style("planning_status", kStatus);
    return layer;
  }
  const std::vector<std::string> farms = farms_of(zone);
  std::vector<ServiceClass> classes;
  for (std::size_t f = 0; f < farms.size(); ++f)
    classes.push_back({farms[f].c_str(), farms[f].empty() ? "Turbine" : farms[f].c_str(), distinct_colour(f)});
  layer.style = point_style("farm", classes);
  return layer;
}

VectorLayer layer_of_viewpoints(const ZoneStudy& study) {
  constexpr std::array<ServiceClass, 1> kAll{{{"viewpoint", "Viewpoint", {20, 60, 140}}}};
  VectorLayer layer{"viewpoints",
                    VectorLayer::Shape::kPoints,
                    {{"what", Type::kText},
                     {"number", Type::kWhole},
                     {"name", Type::kText},
                     {"height_m", Type::kNumber},
                     {"tips_seen", Type::kWhole},
                     {"nearest_m", Type::kNumber}},
                    {},
                    point_style("what", kAll)};
  for (const StudiedViewpoint& studied : study.viewpoints) {
    const Viewpoint& v = studied.viewpoint;
    const SightSummary seen = seen_of(study.zone, studied.bare, all_turbines(study.zone));
    layer.features.push_back({{{v.position.x, v.position.y, v.ground}},
                              {std::string("viewpoint"), static_cast<std::int64_t>(v.number), v.name, v.height,
                               static_cast<std::int64_t>(seen.tips), seen.nearest_m}});
  }
  return layer;
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

std::vector<profile::SheetLine> lines_of(const MapObjects& objects, std::size_t layer) {
  return std::get<profile::SheetLines>(objects.layers[layer]).lines;
}

}  // namespace

std::vector<VectorLayer> study_layers(const ZoneStudy& study) {
  std::vector<VectorLayer> layers{layer_of_turbines(study.zone)};
  if (!study.viewpoints.empty()) layers.push_back(layer_of_viewpoints(study));
  std::vector<profile::SheetLine> routes, links, excluded;
  for (const StudiedRoute& route : study.routes) routes.push_back({route.route.corners, route.title()});
  const LinkStudy radio = exclusion_of(study);
  for (const RadioLink& link : radio.links) {
    links.push_back({{link.from, link.to}, link.id});
    if (std::vector<Point2> outline = exclusion_outline(link, radio); !outline.empty())
      excluded.push_back({std::move(outline), link.id});
  }
  if (!routes.empty()) layers.push_back(layer_of_lines("routes", routes, {0, 110, 60}, 0.6));
  if (!links.empty()) layers.push_back(layer_of_lines("radio_links", links, {150, 20, 110}, 0.4));
  if (!excluded.empty()) layers.push_back(layer_of_lines("exclusion", excluded, {150, 20, 110}, 0.2));
  const MapObjects distances = distance_objects(study.zone.request);
  layers.push_back(layer_of_lines("rings", lines_of(distances, 0), {70, 70, 70}, 0.2));
  layers.push_back(layer_of_lines("study_area", lines_of(distances, 1), {20, 20, 20}, 0.6));
  std::erase_if(layers, [](const VectorLayer& layer) { return layer.features.empty(); });
  return layers;
}

}  // namespace itin::viewshed
