#include "workflows/dwellings/dwelling_sights.hpp"

#include <algorithm>
#include <cmath>

#include <itin/azimuth.hpp>
#include <itin/degrees.hpp>
#include <itin/grazing.hpp>
#include <itin/grid_units.hpp>
#include <itin/same_place.hpp>
#include <viewshed/turbine_sights.hpp>

#include "places/raised_end.hpp"

namespace itin::viewshed {

namespace {

/// The least height of the turbine's axis that is seen, above its ground; no more than the tip's.
double least_height_seen(const PlaceScene& scene, const Earth& earth, const Point3& eye, const Point3& foot,
                         double tip) {
  const Grid& grid = scene.surface().tin.grid;
  const Point2 from = place_in_units(grid, {eye.x, eye.y}), to = place_in_units(grid, {foot.x, foot.y});
  if (same_place(to.x - from.x, to.y - from.y)) return 0;
  const SightLine line({from.x, from.y, eye.z / grid.resolution}, {to.x, to.y, foot.z / grid.resolution},
                       earth.drop_coefficient() * grid.resolution, kGrazing / grid.resolution);
  return std::clamp(raised_end(scene.surface(), line).z * grid.resolution - foot.z, 0.0, tip);
}

}  // namespace

TurbineEnds turbine_ends(const PlaceScene& scene, const DwellingsSurvey& survey, std::size_t turbine) {
  const Turbine& t = survey.request.turbines.turbines[turbine];
  const double ground = survey.ground_m[turbine];
  TurbineEnds ends{turbine, scene.view_from({t.position.x, t.position.y, ground + t.tip_height}), {}};
  if (!t.hub_height) return ends;
  // Ground without data hides the hub as it hides the tip.
  ends.hub = ends.tip;
  ends.hub->eye.z = (ground + *t.hub_height) / scene.surface().tin.grid.resolution;
  return ends;
}

Point3 eye_of_facade(const DwellingsSurvey& survey, const DwellingFacade& facade) {
  return {facade.position.x, facade.position.y, facade.ground_m + survey.request.eye_height};
}

bool is_before(const DwellingFacade& facade, Point2 place) {
  if (!facade.outward_deg) return true;
  const double outward = in_radians(*facade.outward_deg);
  return (place.x - facade.position.x) * std::sin(outward) + (place.y - facade.position.y) * std::cos(outward) > 0;
}

std::vector<TurbineSight> look_at_turbine(const PlaceScene& scene, const DwellingsSurvey& survey,
                                          const TurbineEnds& ends, std::span<const DwellingFacade> facades,
                                          const Progress& progress) {
  const Turbine& turbine = survey.request.turbines.turbines[ends.turbine];
  const Earth& earth = survey.request.earth;
  const Point3 foot{turbine.position.x, turbine.position.y, survey.ground_m[ends.turbine]};
  std::vector<Point3> eyes;
  for (const DwellingFacade& facade : facades) eyes.push_back(eye_of_facade(survey, facade));
  const std::vector<Verdict> tips = scene.judge_all(ends.tip, eyes, progress);
  std::vector<Verdict> hubs;
  if (ends.hub) hubs = scene.judge_all(*ends.hub, eyes, progress);
  std::vector<TurbineSight> sights(facades.size());
  for (std::size_t f = 0; f < facades.size(); ++f) {
    TurbineSight& sight = sights[f];
    sight.tip = Verdict::kOutside;
    sight.distance = std::hypot(foot.x - eyes[f].x, foot.y - eyes[f].y);
    sight.azimuth = grid_azimuth_deg(facades[f].position, turbine.position);
    if (!is_before(facades[f], turbine.position)) continue;
    sight.tip = tips[f];
    if (ends.hub) sight.hub = hubs[f];
    const bool seen = sight.tip == Verdict::kVisible;
    const double least = seen ? least_height_seen(scene, earth, eyes[f], foot, turbine.tip_height) : 0;
    tell_angles({earth, foot.z, turbine.tip_height, eyes[f].z}, least, sight);
  }
  return sights;
}

}  // namespace itin::viewshed
