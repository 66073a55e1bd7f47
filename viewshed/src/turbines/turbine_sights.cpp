#include <algorithm>
#include <cmath>

#include <itin/azimuth.hpp>
#include <itin/parallel.hpp>
#include <profile/profile.hpp>
#include <profile/required_heights.hpp>
#include <profile/wireline.hpp>
#include <viewshed/turbine_sights.hpp>

namespace itin::viewshed {

namespace {

/// Returns the sight of one turbine. `ground` is the elevation on which the turbine stands; both ends keep their bare
/// ground whatever the surface.
TurbineSight sight_to(const SectionSurface& surface, const Viewpoint& from, const Turbine& turbine, double ground,
                      const ZoneRequest& request) {
  TurbineSight sight;
  const CrossSection section = surface.between(from.position, turbine.position);
  const Point2 foot = section.one_place ? from.position : turbine.position;
  sight.distance = std::hypot(foot.x - from.position.x, foot.y - from.position.y);
  sight.azimuth = grid_azimuth_deg(from.position, foot);
  sight.gaps = !section.gaps.empty();
  const profile::Profile profile = profile::from_section(section);
  const auto seen = profile::visible_height(profile, from.height, {turbine.hub_height, turbine.tip_height},
                                            request.earth, profile::EndGrounds{from.ground, ground});
  const double least = std::max(0.0, seen.from_m);
  const auto judged = [&](bool clear_of_known_ground) {
    if (!clear_of_known_ground || (sight.gaps && request.nodata == NoData::kBlock))
      return TurbineSight::Verdict::kHidden;
    return sight.gaps && request.nodata == NoData::kUnknown ? TurbineSight::Verdict::kUndecided
                                                            : TurbineSight::Verdict::kVisible;
  };
  const bool tip_clear = seen.tip.visible_m > 0;
  sight.tip = judged(tip_clear);
  if (turbine.hub_height) sight.hub = judged(tip_clear && least <= *turbine.hub_height);
  tell_angles({request.earth, ground, turbine.tip_height, from.ground + from.height}, least, sight);
  return sight;
}

}  // namespace

std::vector<TurbineSight> sights_to_all(const SectionSurface& surface, const Viewpoint& from, const Zone& zone) {
  std::vector<TurbineSight> sights(zone.request.turbines.size());
  parallel_for(sights.size(), [&](std::size_t k) {
    sights[k] = sight_to(surface, from, zone.request.turbines[k], zone.ground_m[k], zone.request);
  });
  return sights;
}

void tell_angles(const TurbineFromEye& turbine, double least, TurbineSight& sight) {
  const auto angle = [&](double height) {
    return profile::apparent_angle_deg(turbine.earth, sight.distance, turbine.ground_m + height - turbine.eye_m);
  };
  sight.tip_deg = angle(turbine.tip_height);
  if (sight.tip != TurbineSight::Verdict::kVisible) return;
  sight.visible = turbine.tip_height - least;
  sight.vertical_deg = sight.tip_deg - angle(least);
}

}  // namespace itin::viewshed
