#include "lines/paths/path_cover.hpp"

#include <map>

namespace itin::profile {

std::vector<ThemeLength> path_cover(const Profile& profile) {
  std::map<std::uint16_t, double> lengths;
  for (std::size_t i = 0; i + 1 < profile.points.size(); ++i) {
    const double length = profile.points[i + 1].distance_m - profile.points[i].distance_m;
    if (length > 0 && profile.joined(i)) lengths[profile.theme_between(i)] += length;
  }
  std::vector<ThemeLength> cover;
  for (const auto& [theme, length] : lengths) cover.push_back({theme, length});
  return cover;
}

}  // namespace itin::profile
