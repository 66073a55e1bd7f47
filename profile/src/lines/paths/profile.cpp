#include <algorithm>

#include <itin/error.hpp>
#include <itin/section_themes.hpp>
#include <itin/store.hpp>
#include <profile/profile.hpp>

namespace itin::profile {

double Profile::gap_length_m() const {
  double length = 0;
  for (const auto& [from, to] : gaps) length += to - from;
  return length;
}

bool Profile::joined(std::size_t i) const {
  const double from = points[i].distance_m, to = points[i + 1].distance_m;
  if (from == to) return true;
  const auto gap = std::lower_bound(gaps.begin(), gaps.end(), from,
                                    [](const std::pair<double, double>& g, double d) { return g.second <= d; });
  return gap == gaps.end() || gap->first >= to;
}

std::uint16_t Profile::theme_between(std::size_t i) const {
  const ProfilePoint &a = points[i], &b = points[i + 1];
  return theme_of_piece(a.theme, a.ground_m, b.theme, b.ground_m);
}

std::vector<FeatureRun> feature_runs(const Profile& profile) {
  std::vector<FeatureRun> runs;
  for (std::size_t i = 0; i + 1 < profile.points.size(); ++i) {
    const std::uint16_t theme = profile.theme_between(i);
    if (theme == 0 || !profile.joined(i)) continue;
    const bool goes_on = !runs.empty() && runs.back().last == i && runs.back().theme == theme;
    if (goes_on) {
      runs.back().last = i + 1;
    } else {
      runs.push_back({i, i + 1, theme});
    }
  }
  return runs;
}

EndGrounds ends_of(const Profile& profile) {
  if (profile.points.empty()) throw InputError("the profile has no points, and so no ends");
  return {profile.points.front().ground_m, profile.points.back().ground_m};
}

std::optional<double> height_at(const Profile& profile, double distance_m) {
  const auto& points = profile.points;
  const auto before = [](const ProfilePoint& p, double d) { return p.distance_m < d; };
  const auto at = std::lower_bound(points.begin(), points.end(), distance_m, before);
  if (at == points.end()) return std::nullopt;
  if (at->distance_m == distance_m) {
    double height = at->ground_m;
    for (auto p = at; p != points.end() && p->distance_m == distance_m; ++p) height = std::max(height, p->ground_m);
    return height;
  }
  if (at == points.begin()) return std::nullopt;
  const ProfilePoint &a = *(at - 1), &b = *at;
  if (!profile.joined(static_cast<std::size_t>(at - points.begin()) - 1)) return std::nullopt;
  return a.ground_m + (b.ground_m - a.ground_m) * ((distance_m - a.distance_m) / (b.distance_m - a.distance_m));
}

bool has_ground_at_ends(const Profile& profile) {
  return !profile.points.empty() && profile.points.front().distance_m == 0 &&
         profile.points.back().distance_m == profile.length_m;
}

Profile from_section(const CrossSection& section) {
  Profile profile;
  profile.length_m = section.length;
  profile.one_place = section.one_place;
  profile.points.reserve(section.breakpoints.size());
  for (const Breakpoint& b : section.breakpoints) {
    profile.points.push_back({b.distance, b.position.x, b.position.y, b.position.z, 0, b.theme});
  }
  for (const SectionGap& gap : section.gaps) profile.gaps.emplace_back(gap.from, gap.to);
  return profile;
}

std::vector<std::string> theme_names(const StoreMetadata& metadata) {
  std::vector<std::string> names{"terrain"};
  for (const ThemeInfo& theme : metadata.themes) names.push_back(theme.name);
  return names;
}

Profile reversed(const Profile& profile) {
  Profile mirror = profile;
  std::reverse(mirror.points.begin(), mirror.points.end());
  for (ProfilePoint& p : mirror.points) p.distance_m = profile.length_m - p.distance_m;
  std::reverse(mirror.gaps.begin(), mirror.gaps.end());
  for (auto& [from, to] : mirror.gaps) {
    const double mirrored = profile.length_m - to;
    to = profile.length_m - from;
    from = mirrored;
  }
  return mirror;
}

}  // namespace itin::profile
