// Measures what a path crosses, by theme.
#pragma once

#include <cstdint>
#include <vector>

#include <profile/profile.hpp>

namespace itin::profile {

struct ThemeLength {
  std::uint16_t theme = 0;  ///< as in ProfilePoint; 0: ground on which nothing stands
  double length_m = 0;
};

/// The metres over each theme that the path crosses, in the themes' order. They add up to the length less the gaps.
std::vector<ThemeLength> path_cover(const Profile& profile);

}  // namespace itin::profile
