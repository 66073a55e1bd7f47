#include "turbines/radar_survey.hpp"

#include <cmath>
#include <limits>

#include <itin/grid_units.hpp>

namespace itin::viewshed {

namespace {

/// Lines are tested up to this height above the ground, metres.
constexpr double kRadarCeiling = 1000;

Eye eye_of_radar(const Grid& units, std::optional<double> ground_m, const ZoneRequest& zone) {
  Request request;
  request.earth = zone.earth;
  return eye_of(units, request, *zone.radar, ground_m);
}

}  // namespace

struct RadarSurvey::Screen {
  const FullSurface& ground;
  const RadialSweep::View& view;
  const VoidShadow* shadow;  ///< what ground without data hides; may be null

  bool shades(Point2 units) const { return shadow != nullptr && shadow->holds(units.x, units.y); }
};

RadarSurvey::RadarSurvey(const Grid& units, std::optional<double> ground_m, Zone& zone)
    : zone_(zone), eye_(eye_of_radar(units, ground_m, zone.request)) {
  RadarView& seen = zone.radar.emplace();
  seen.ground_m = *ground_m;
  seen.height_m.assign(zone.grid.cell_count(), std::numeric_limits<float>::quiet_NaN());
  seen.turbine_m.assign(zone.request.turbines.size(), 0);
}

void RadarSurvey::run(const FullSurface& ground, const ZonePart& part, Stage& stage) {
  std::optional<VoidShadow> shadow;
  // The part's window is convex: where it ends, no sight line does.
  if (zone_.request.nodata == NoData::kBlock) shadow.emplace(ground.rim(), eye_.units);
  const RadialSweep::View view = ground.view_from(eye_);
  const Screen screen{ground, view, shadow ? &*shadow : nullptr};
  stage.for_each(part.radar_tiles.size(), [&](std::size_t i) {
    survey_tile(screen, part.radar_tiles[i]);
    return std::size_t{1};
  });
  for (const std::size_t turbine : part.radar_turbines) zone_.radar->turbine_m[turbine] = seen_of(screen, turbine);
}

void RadarSurvey::survey_tile(const Screen& screen, std::size_t tile) {
  const auto work = screen.ground.begin(tile);
  const double resolution = screen.ground.units().resolution;
  for (std::size_t i = 0; i < work->ground.size(); ++i) work->targets[i] = work->ground[i] + kRadarCeiling / resolution;
  screen.ground.raise_from(screen.view, {work->ground, work->ground}, *work);
  for_each_cell(work->tile, [&](std::size_t cell, RasterGrid::Cell place) {
    if (std::isnan(work->ground[cell]) || std::isnan(work->seen[cell]) || screen.shades(work->centres.at(cell))) return;
    const bool at_radar = std::isinf(work->seen[cell]);
    zone_.radar->height_m[zone_.grid.index(place)] =
        at_radar ? 0 : static_cast<float>((work->seen[cell] - work->ground[cell]) * resolution);
  });
}

double RadarSurvey::seen_of(const Screen& screen, std::size_t turbine) const {
  const Turbine& t = zone_.request.turbines[turbine];
  const double ground_m = zone_.ground_m[turbine];
  const Grid& units = screen.ground.units();
  const double tip = (ground_m + t.tip_height) / units.resolution;
  const double least = screen.ground.raise_from(screen.view, t.position, ground_m / units.resolution, tip);
  if (std::isinf(least)) return t.tip_height;
  const Point2 place{easting_in_units(units, t.position.x), northing_in_units(units, t.position.y)};
  return screen.shades(place) || std::isnan(least) ? 0 : (tip - least) * units.resolution;
}

}  // namespace itin::viewshed
