#include "turbines/radar_survey.hpp"

#include <cmath>
#include <limits>

#include "line/grid_units.hpp"
#include "progress/stage.hpp"

namespace itin::viewshed {

namespace {

void survey_tile(const RadialSweep::View& radar, const FullSurface& surface, const VoidShadow* shadow,
                 FullSurface::TileWork& work, std::vector<float>& result) {
  const double resolution = surface.units().resolution;
  for (std::size_t i = 0; i < work.ground.size(); ++i) work.targets[i] = work.ground[i] + kRadarCeiling / resolution;
  surface.raise_from(radar, {work.ground, work.ground}, work);
  for_each_cell(work.tile, [&](std::size_t cell, RasterGrid::Cell place) {
    if (std::isnan(work.ground[cell]) || std::isnan(work.seen[cell])) return;
    const Point2 top = work.centres.at(cell);
    if (shadow != nullptr && shadow->holds(top.x, top.y)) return;
    const bool at_radar = std::isinf(work.seen[cell]);
    result[surface.grid().index(place)] =
        at_radar ? 0 : static_cast<float>((work.seen[cell] - work.ground[cell]) * resolution);
  });
}

}  // namespace

std::vector<float> radar_heights(const RadialSweep::View& radar, const FullSurface& surface, const VoidShadow* shadow,
                                 Progress& progress) {
  std::vector<float> result(surface.grid().cell_count(), std::numeric_limits<float>::quiet_NaN());
  for_each_step(surface.tiles().cell_count(), "radar", progress,
                [&](std::size_t tile) { survey_tile(radar, surface, shadow, *surface.begin(tile), result); });
  return result;
}

double radar_sees(const RadialSweep::View& radar, const FullSurface& surface, const VoidShadow* shadow,
                  const Turbine& turbine, double ground_m) {
  const Grid& units = surface.units();
  const double tip = (ground_m + turbine.tip_height) / units.resolution;
  const double least = surface.raise_from(radar, turbine.position, ground_m / units.resolution, tip);
  if (std::isinf(least)) return turbine.tip_height;
  const bool shaded = shadow != nullptr && shadow->holds(easting_in_units(units, turbine.position.x),
                                                         northing_in_units(units, turbine.position.y));
  return shaded || std::isnan(least) ? 0 : (tip - least) * units.resolution;
}

}  // namespace itin::viewshed
