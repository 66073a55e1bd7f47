#include "workflows/premises/output/premises_map.hpp"

#include <algorithm>

#include <fmt/format.h>

#include <itin/counted.hpp>
#include <itin/in_ring.hpp>
#include <itin/sources_in.hpp>
#include <viewshed/result_sheet.hpp>

#include "workflows/premises/output/wall_service.hpp"

namespace itin::viewshed {

namespace {

using Sample = profile::SheetKey::Sample;

constexpr Rgba kOutlineOutOfReach{120, 120, 120, 255};

/// The buildings of a class, in colours that leave walls to be seen.
MapObjects buildings_of(const PremisesSurvey& survey, PremisesService service) {
  const FeatureClass& shown = class_of(service);
  profile::SheetAreas buildings{{}, {shown.colour.red, shown.colour.green, shown.colour.blue, 90}};
  for (const Premises& p : survey.premises)
    if (service_of(p) == service) buildings.areas.push_back(p.foot);
  if (buildings.areas.empty()) return {};
  return {{buildings}, {{Sample::kPatch, {buildings.colour}, shown.text}}};
}

/// Returns the buildings beyond the radius, with outlines: no walls are drawn of them, and the ground is grey as well.
MapObjects buildings_out_of_reach(const PremisesSurvey& survey) {
  MapObjects buildings = buildings_of(survey, PremisesService::kOutOfReach);
  profile::SheetLines outlines{{}, kOutlineOutOfReach, 0.25, false};
  for (const Premises& p : survey.premises)
    if (service_of(p) == PremisesService::kOutOfReach)
      for (const std::vector<Point2>& ring : p.foot) outlines.lines.push_back({ring, ""});
  if (!outlines.lines.empty()) buildings.layers.emplace_back(std::move(outlines));
  return buildings;
}

std::vector<Point2> in_plan(const std::vector<Point3>& line) {
  std::vector<Point2> plan;
  for (const Point3& p : line) plan.push_back({p.x, p.y});
  return plan;
}

MapObjects walls_of(const PremisesSurvey& survey, WallService service) {
  profile::SheetLines lines{{}, {}, 0.6, false};
  for (const Premises& p : survey.premises) {
    if (service_of(p) == PremisesService::kOutOfReach) continue;
    for (const WallPlace& wall : p.walls)
      if (service_of(wall, survey.request.storey) == service) lines.lines.push_back({in_plan(wall.stretch), ""});
  }
  if (lines.lines.empty()) return {};
  const FeatureClass& shown = class_of(service);
  lines.colour = shown.colour;
  return {{std::move(lines)}, {{Sample::kLine, {shown.colour}, shown.text}}};
}

std::vector<MapObjects> premises_objects(const PremisesSurvey& survey) {
  std::vector<MapObjects> objects{buildings_out_of_reach(survey)};
  for (const PremisesService service :
       {PremisesService::kUnserved, PremisesService::kUndecided, PremisesService::kWall, PremisesService::kRoof})
    objects.push_back(buildings_of(survey, service));
  for (const WallService service :
       {WallService::kUnserved, WallService::kUndecided, WallService::kHigh, WallService::kLow})
    objects.push_back(walls_of(survey, service));
  std::vector<profile::SheetMark> masts;
  for (const SitePosition& mast : survey.masts) masts.push_back({mast.position, mast.name});
  objects.push_back(mast_objects(masts, "Mast"));
  return objects;
}

/// The box about the buildings within reach and the masts.
Box shown_box(const PremisesSurvey& survey) {
  Box box;
  for (const SitePosition& mast : survey.masts) box.extend(mast.position);
  for (const Premises& p : survey.premises)
    if (!p.links.empty()) box.extend(box_of_rings(p.foot));
  const double margin = 0.03 * std::max(box.width(), box.height());
  return {box.xmin - margin, box.ymin - margin, box.xmax + margin, box.ymax + margin};
}

profile::TitleBlock title_of_premises(const Store& store, const PremisesSurvey& survey, const Box& shown) {
  const PremisesRequest& request = survey.request;
  const PremisesCounts counts = survey.counts();
  profile::TitleBlock title;
  title.title = "Premises served by " + counted(survey.masts.size(), "mast");
  title.statement = statement_of(survey.metadata, request.themes, Detail::tolerance(0));
  title.facts = {
      {"Premises", fmt::format("{} of {} served: {} on a wall, {} on the roof alone", grouped(counts.served()),
                               grouped(counts.all), grouped(counts.on_walls), grouped(counts.on_roofs))},
      {"Antennas", fmt::format("{:g} m before walls, at storeys of {:g} m; on roofs {:g} m up and higher",
                               request.reveal, request.storey, request.poles.front())},
      {"Served", request.frequency_ghz ? fmt::format("in sight with {:g} F1 clear at {:g} GHz, within {:g} m",
                                                     request.fresnel, *request.frequency_ghz, request.radius)
                                       : fmt::format("in sight, within {:g} m", request.radius)},
      {"Earth", request.earth.convention()}};
  title.sources = described(sources_in(store, shown, request.themes), survey.metadata);
  return title;
}

}  // namespace

std::string premises_map(const Store& store, const PremisesSurvey& survey, const profile::SheetChoice& sheets,
                         const std::string& name, Progress& progress) {
  const Box shown = shown_box(survey);
  const ResultSheet sheet = object_sheet(shown, premises_objects(survey), title_of_premises(store, survey, shown));
  return draw_result_sheet(store, sheet, profile::PaperSize::kA3, sheets.names(), name, progress);
}

}  // namespace itin::viewshed
