#include <algorithm>

#include <profile/profile.hpp>

namespace itin::profile {

bool Profile::joined(std::size_t i) const {
  const double from = points[i].distance_m, to = points[i + 1].distance_m;
  if (from == to) return true;
  const auto gap = std::lower_bound(gaps.begin(), gaps.end(), from,
                                    [](const std::pair<double, double>& g, double d) { return g.second <= d; });
  return gap == gaps.end() || gap->first >= to;
}

Profile from_section(const CrossSection& section) {
  Profile profile;
  profile.length_m = section.length;
  profile.points.reserve(section.breakpoints.size());
  for (const Breakpoint& b : section.breakpoints) {
    profile.points.push_back({b.distance, b.position.x, b.position.y, b.position.z});
  }
  for (const SectionGap& gap : section.gaps) profile.gaps.emplace_back(gap.from, gap.to);
  return profile;
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
