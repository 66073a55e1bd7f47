#include "lines/critical_point.hpp"

#include <algorithm>

#include <itin/grazing.hpp>

namespace itin::profile {

namespace {

/// The theme of the feature at a distance; 0 for none.
std::uint16_t feature_theme_at(const Profile& profile, double distance_m) {
  const auto& points = profile.points;
  const auto before = [](const ProfilePoint& p, double d) { return p.distance_m < d; };
  const auto at = std::lower_bound(points.begin(), points.end(), distance_m, before);
  const auto found = static_cast<std::size_t>(at - points.begin());
  for (std::size_t i = found == 0 ? 0 : found - 1; i + 1 < points.size() && points[i].distance_m <= distance_m; ++i)
    if (profile.theme_between(i) != 0) return profile.theme_between(i);
  return 0;
}

}  // namespace

CriticalPoint critical_point(const Profile& profile, const Antennas& antennas, const Earth& earth,
                             const LineClearance& line, const std::optional<FresnelClearance>& zone) {
  if (line.clearance_m < -kGrazing || !zone) return {line.critical, line.clearance_m};
  const double d = zone->distance_m, t = d / profile.length_m;
  const ProfilePoint &a = profile.points.front(), &b = profile.points.back();
  const double bulge = earth.drop_coefficient() * d * (profile.length_m - d);
  ProfilePoint p;
  p.distance_m = d;
  p.x = a.x + (b.x - a.x) * t, p.y = a.y + (b.y - a.y) * t;
  p.ground_m = antennas.from_m * (1 - t) + antennas.to_m * t - bulge - zone->clearance_m;
  p.theme = feature_theme_at(profile, d);
  return {p, zone->clearance_m};
}

}  // namespace itin::profile
