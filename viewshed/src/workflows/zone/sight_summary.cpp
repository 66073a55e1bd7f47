#include "workflows/zone/sight_summary.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include <itin/azimuth.hpp>
#include <itin/degrees.hpp>

namespace itin::viewshed {

Arc arc_to_shown(const std::vector<TurbineSight>& sights) {
  const bool none = std::none_of(sights.begin(), sights.end(), is_shown);
  std::vector<Arc> arcs;
  for (const TurbineSight& s : sights)
    if (none || is_shown(s)) arcs.push_back({s.azimuth, 0});
  return rotor_horizon(arcs).held;
}

SightSummary seen_of(const std::vector<Turbine>& all, const std::vector<TurbineSight>& sights,
                     const std::vector<std::size_t>& turbines) {
  SightSummary seen;
  seen.turbines = turbines.size(), seen.nearest = turbines.front();
  std::vector<Arc> rotors;
  for (const std::size_t k : turbines) {
    const TurbineSight& s = sights[k];
    if (s.hub) {
      ++seen.hubs_known;
      seen.hubs = seen.hubs.value_or(0) + (*s.hub == TurbineSight::Verdict::kVisible ? 1 : 0);
      seen.hubs_undecided = seen.hubs_undecided.value_or(0) + (*s.hub == TurbineSight::Verdict::kUndecided ? 1 : 0);
    }
    if (s.distance < sights[seen.nearest].distance) seen.nearest = k;
    seen.gaps = seen.gaps || s.gaps;
    if (s.tip == TurbineSight::Verdict::kUndecided) ++seen.tips_undecided;
    if (s.tip != TurbineSight::Verdict::kVisible) continue;
    ++seen.tips;
    if (s.distance > all[k].radius) ++seen.tips_beyond;
    const double half = in_degrees(std::atan2(all[k].rotor_diameter.value_or(0) / 2, s.distance));
    rotors.push_back({within_turn(s.azimuth - half), 2 * half});
    seen.vertical_deg = std::max(seen.vertical_deg, s.vertical_deg);
    if (!seen.nearest_seen || s.distance < sights[*seen.nearest_seen].distance) seen.nearest_seen = k;
  }
  seen.nearest_m = sights[seen.nearest].distance;
  if (!rotors.empty()) seen.arc = rotor_horizon(rotors).held;
  return seen;
}

std::vector<std::size_t> all_turbines(const Zone& zone) {
  std::vector<std::size_t> all(zone.request.turbines.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  return all;
}

std::string before_the_eye(const SectionSurface& surface, const Viewpoint& from, Point2 to,
                           const std::vector<std::string>& themes) {
  constexpr double kClose = 100;
  const double distance = std::hypot(to.x - from.position.x, to.y - from.position.y);
  const double reach = std::min(1.0, kClose / std::max(distance, 1e-9)), eye = from.ground + from.height;
  const CrossSection section = surface.between(from.position, {from.position.x + reach * (to.x - from.position.x),
                                                               from.position.y + reach * (to.y - from.position.y)});
  for (const Breakpoint& p : section.breakpoints) {
    if (p.theme == 0 || p.position.z <= eye) continue;
    const std::string& what = themes.at(p.theme - std::size_t{1});
    if (p.distance == 0)
      return fmt::format(
          "The viewpoint stands within a feature of '{}' that rises {:.1f} m above the ground there, "
          "above the eye: nothing is seen beyond it.",
          what, p.position.z - from.ground);
    return fmt::format(
        "A feature of '{}' stands {:.0f} m in front of the eye, in the direction of the nearest turbine; it "
        "rises {:.1f} m above the eye there.",
        what, p.distance, p.position.z - eye);
  }
  return "";
}

}  // namespace itin::viewshed
