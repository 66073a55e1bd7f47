#include "turbines/radar_survey.hpp"

#include <cmath>

#include <itin/grid_units.hpp>

#include "turbines/value_bands.hpp"

namespace itin::viewshed {

namespace {

Eye eye_of_radar(const Grid& units, std::optional<double> ground_m, const ZoneRequest& zone) {
  Request request;
  request.earth = zone.earth;
  return eye_of(units, request, *zone.radar, ground_m);
}

}  // namespace

struct RadarSurvey::PartView {
  const ExactScene& ground;
  const RadialSweep::View& view;
  const std::optional<VoidShadow>& shadow;  ///< nothing where no line crosses ground without data

  bool shades(Point2 units) const { return shadow && shadow->holds(units.x, units.y); }
};

RadarSurvey::RadarSurvey(const Grid& units, std::optional<double> ground_m, Zone& zone)
    : zone_(zone), eye_(eye_of_radar(units, ground_m, zone.request)) {
  zone.radar->ground_m = *ground_m;
}

void RadarSurvey::run(const ExactScene& ground, const ZonePart& part, Stage& stage) {
  if (part.radar_tiles.empty() && part.radar_turbines.empty()) return;
  const RadialSweep::View view = ground.view_from(eye_);
  std::optional<VoidShadow> shadow;
  // The part's window is convex: where it ends, no sight line does.
  if (zone_.radar->crosses_voids) shadow.emplace(ground.rim(), eye_.units);
  const PartView over{ground, view, shadow};
  stage.for_each(part.radar_tiles.size(), [&](std::size_t i) {
    survey_tile(over, part.radar_tiles[i]);
    return std::size_t{1};
  });
  for (const std::size_t turbine : part.radar_turbines) survey_turbine(over, turbine);
}

void RadarSurvey::survey_tile(const PartView& over, std::size_t tile) {
  const auto work = over.ground.begin(tile);
  const double resolution = over.ground.units().resolution;
  for (std::size_t i = 0; i < work->ground.size(); ++i) work->targets[i] = work->ground[i] + kRadarCeiling / resolution;
  over.ground.raise_from(over.view, {work->ground, work->ground}, *work);
  for_each_cell(work->tile, [&](std::size_t cell, RasterGrid::Cell place) {
    if (std::isnan(work->ground[cell]) || std::isnan(work->seen[cell])) return;
    const bool shaded = over.shades(work->centres.at(cell));
    std::vector<float>& heights = shaded ? zone_.radar->undecided_height_m : zone_.radar->height_m;
    if (heights.empty()) return;  // it is hidden
    const bool at_radar = std::isinf(work->seen[cell]);
    heights[zone_.grid.index(place)] =
        at_radar ? 0 : static_cast<float>((work->seen[cell] - work->ground[cell]) * resolution);
  });
}

void RadarSurvey::survey_turbine(const PartView& over, std::size_t turbine) {
  const Turbine& t = zone_.request.turbines[turbine];
  const double ground_m = zone_.ground_m[turbine];
  const Grid& units = over.ground.units();
  const double tip = (ground_m + t.tip_height) / units.resolution;
  const double least = over.ground.raise_from(over.view, t.position, ground_m / units.resolution, tip);
  if (std::isnan(least)) return;
  const bool shaded = over.shades(place_in_units(units, t.position));
  std::vector<double>& seen = shaded ? zone_.radar->undecided_turbine_m : zone_.radar->turbine_m;
  if (seen.empty()) return;  // it is hidden
  seen[turbine] = std::isinf(least) ? t.tip_height : (tip - least) * units.resolution;
}

}  // namespace itin::viewshed
