// Clutter as something that stands on the ground.
#pragma once

#include <profile/profile.hpp>

namespace itin::profile {

inline constexpr std::uint16_t kClutterTheme = 1;

/// The tops of the clutter over the ground, as a surface of theme kClutterTheme; bare nearer to an end than
/// kClutterFreeM, as the losses take it (P.452-18).
Profile clutter_raised(const Profile& ground);

}  // namespace itin::profile
