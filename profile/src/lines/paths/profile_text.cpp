#include <algorithm>
#include <iterator>

#include <fmt/format.h>

#include <itin/error.hpp>
#include <itin/precondition.hpp>
#include <profile/profile_text.hpp>

namespace itin::profile {

namespace {

/// A height below this does not reach the text's last digit.
constexpr double kNothing = 0.005;

std::vector<double> distances_of(const Profile& surface, const Profile& ground) {
  std::vector<double> distances;
  for (const Profile* profile : {&surface, &ground})
    for (const ProfilePoint& p : profile->points) distances.push_back(p.distance_m);
  std::sort(distances.begin(), distances.end());
  return distances;
}

/// The theme of the highest point at a distance or, between points, of what stands between them.
std::uint16_t highest_theme_at(const Profile& surface, double distance_m) {
  const auto& points = surface.points;
  const auto after = std::upper_bound(points.begin(), points.end(), distance_m,
                                      [](double d, const ProfilePoint& p) { return d < p.distance_m; });
  const auto first = std::lower_bound(points.begin(), after, distance_m,
                                      [](const ProfilePoint& p, double d) { return p.distance_m < d; });
  if (first != after)
    return std::max_element(first, after, [](const auto& a, const auto& b) { return a.ground_m < b.ground_m; })->theme;
  return surface.theme_between(static_cast<std::size_t>(first - points.begin()) - 1);
}

char kind_letter(std::uint16_t theme, const std::vector<ThemeKind>& kinds) {
  const bool known = theme > 0 && theme <= kinds.size();
  return known && kinds[theme - 1U] == ThemeKind::Vegetation ? 'T' : 'B';
}

}  // namespace

std::string profile_text(const Profile& surface, const Profile& ground, const std::vector<ThemeKind>& kinds) {
  ITIN_PRECONDITION(surface.gaps.empty());
  std::string text, before;
  for (const double d : distances_of(surface, ground)) {
    const std::string distance = fmt::format("{:.6f}", d / 1000);
    if (distance == before) continue;
    before = distance;
    const double top = *height_at(surface, d), foot = ground.points.empty() ? top : *height_at(ground, d);
    const double height = std::max(0.0, top - foot);
    const bool stands = height >= kNothing;
    fmt::format_to(std::back_inserter(text), "{}\t{:.2f}\t{:.2f}\t{}\n", distance, foot, stands ? height : 0,
                   stands ? kind_letter(highest_theme_at(surface, d), kinds) : 'N');
  }
  return text;
}

void require_profile_text(const Profile& surface, const std::string& name) {
  if (surface.gaps.empty()) return;
  throw InputError(fmt::format("{}: {:.1f} m of the line are without data, which .txt cannot tell; write .csv", name,
                               surface.gap_length_m()));
}

}  // namespace itin::profile
