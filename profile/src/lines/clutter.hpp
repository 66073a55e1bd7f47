// Treats clutter as something that stands on the ground.
#pragma once

#include <profile/profile.hpp>

namespace itin::profile {

inline constexpr std::uint16_t kClutterTheme = 1;

/// Returns the tops of the clutter over the ground, as a surface of theme kClutterTheme. It is bare nearer to an end
/// than kClutterFreeM, as it is for the losses (P.452-18).
Profile clutter_raised(const Profile& ground);

}  // namespace itin::profile
