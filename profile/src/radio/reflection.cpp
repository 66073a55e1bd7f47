#include <cmath>

#include <itin/degrees.hpp>
#include <itin/grazing.hpp>
#include <itin/smooth_path.hpp>
#include <profile/diffraction.hpp>

#include "lines/line_clearance.hpp"

namespace itin::profile {

namespace {

/// The part of the line up to a place on it, or from there on, with this place as its end.
Profile part_of(const Profile& whole, const ProfilePoint& place, bool before) {
  const double shift = before ? 0 : place.distance_m;
  Profile part;
  part.length_m = before ? place.distance_m : whole.length_m - place.distance_m;
  const auto add = [&](ProfilePoint p) {
    p.distance_m -= shift;
    part.points.push_back(p);
  };
  if (!before) add(place);
  for (const ProfilePoint& p : whole.points)
    if (before ? p.distance_m < place.distance_m : p.distance_m > place.distance_m) add(p);
  if (before) add(place);
  for (const auto& [from, to] : whole.gaps)
    if (before ? to <= place.distance_m : from >= place.distance_m) part.gaps.emplace_back(from - shift, to - shift);
  return part;
}

/// The point of the profile's line at a distance where its ground is known.
ProfilePoint place_at(const Profile& profile, double distance_m, double ground_m) {
  const ProfilePoint &a = profile.points.front(), &b = profile.points.back();
  const double t = distance_m / profile.length_m;
  ProfilePoint place{distance_m, a.x + (b.x - a.x) * t, a.y + (b.y - a.y) * t, ground_m};
  for (std::size_t i = 0; i + 1 < profile.points.size(); ++i) {
    const bool holds = profile.points[i].distance_m <= distance_m && distance_m <= profile.points[i + 1].distance_m;
    if (holds && profile.joined(i)) place.theme = profile.theme_between(i);
  }
  return place;
}

/// Finds what rises highest above the two legs of the reflected path; or the place itself, where the ground there is
/// above the direct path.
void find_screen(const Profile& profile, const Antennas& antennas, const RadioPath& path, const ProfilePoint& place,
                 Reflection& found) {
  Earth earth;
  earth.effective_factor = path.effective_earth_km * 1000 / earth.radius;
  const double along = place.distance_m, rest = profile.length_m - along,
               direct_m = (antennas.from_m * rest + antennas.to_m * along) / profile.length_m -
                          earth.drop_coefficient() * along * rest;
  if (place.ground_m - direct_m > kGrazing) {
    found.screen = place;
    found.screen_depth_m = place.ground_m - direct_m;
    return;
  }
  for (const bool before : {true, false}) {
    const Antennas leg = before ? Antennas{antennas.from_m, place.ground_m} : Antennas{place.ground_m, antennas.to_m};
    const std::optional<LineClearance> least = line_clearance(part_of(profile, place, before), leg, earth);
    if (!least || -least->clearance_m <= std::max(kGrazing, found.screen_depth_m)) continue;
    found.screen_depth_m = -least->clearance_m;
    found.screen = least->critical;
    if (!before) found.screen->distance_m += place.distance_m;
  }
}

}  // namespace

std::optional<Reflection> reflection(const Profile& profile, const Antennas& antennas, const RadioPath& path,
                                     const Profile* bare) {
  if (!profile.has_length()) return std::nullopt;
  const SmoothHeights smooth = smooth_heights(bare != nullptr ? *bare : profile, antennas);
  const SmoothPath above{profile.length_m / 1000, antennas.from_m - smooth.hst_m, antennas.to_m - smooth.hsr_m};
  if (above.from_m <= 0 || above.to_m <= 0) return std::nullopt;
  const double radius = path.effective_earth_km, d1 = reflection_km(above, radius), d2 = above.distance_km - d1;
  // The heights are taken over the plane that touches the surface at the reflection.
  const double from = above.from_m - 500 * d1 * d1 / radius, to = above.to_m - 500 * d2 * d2 / radius;
  if (from <= 0 || to <= 0) return std::nullopt;
  Reflection found;
  found.distance_m = d1 * 1000;
  found.grazing_deg = in_degrees(std::atan2(from, found.distance_m));
  found.longer_by_m = 2 * from * to / profile.length_m;
  found.ground_m = height_at(profile, found.distance_m);
  if (!found.ground_m) return found;
  const ProfilePoint place = place_at(profile, found.distance_m, *found.ground_m);
  found.theme = place.theme;
  find_screen(profile, antennas, path, place, found);
  return found;
}

}  // namespace itin::profile
