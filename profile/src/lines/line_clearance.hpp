// The ray over a profile: its least clearance, and where that is.
#pragma once

#include <optional>

#include <itin/earth.hpp>
#include <profile/fresnel.hpp>
#include <profile/profile.hpp>

namespace itin::profile {

struct LineClearance {
  double clearance_m = 0;  ///< least, both ends included; negative where the ray is cut
  ProfilePoint critical;   ///< there, on the ground; its theme and feature are those of what stands there
};

/// Nothing where the profile has no points. Between two joined points the clearance is a quadratic of the distance,
/// convex, so that its least value is in closed form. O(n).
std::optional<LineClearance> line_clearance(const Profile& profile, const Antennas& antennas, const Earth& earth);

}  // namespace itin::profile
