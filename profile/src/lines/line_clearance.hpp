// The least clearance of a ray over a profile, and the place where it occurs.
#pragma once

#include <optional>

#include <itin/earth.hpp>
#include <profile/fresnel.hpp>
#include <profile/profile.hpp>

namespace itin::profile {

struct LineClearance {
  double clearance_m = 0;  ///< least, both ends included; negative where the ray is cut
  ProfilePoint critical;   ///< its place on the ground; theme and feature are those of what stands there
};

/// Finds the least clearance. Ends at one place have no ground between them, and the clearance is the one over their
/// own ground. Nothing where there is no ground to clear. Between two joined points the clearance is a convex quadratic
/// of the distance, so that its least value is in closed form. O(n).
std::optional<LineClearance> line_clearance(const Profile& profile, const Antennas& antennas, const Earth& earth);

}  // namespace itin::profile
