// The point of a ray that a planner looks at.
#pragma once

#include <optional>

#include <itin/earth.hpp>
#include <profile/fresnel.hpp>
#include <profile/profile.hpp>

#include "lines/line_clearance.hpp"

namespace itin::profile {

struct CriticalPoint {
  ProfilePoint point;
  double clearance_m = 0;
};

/// The point where the ray is cut deepest, as `line` tells. If the ray is free, the point at `zone`, its tightest place
/// at any wavelength. So the point is never an end at which an antenna merely stands little above its own foot. O(log
/// n).
CriticalPoint critical_point(const Profile& profile, const Antennas& antennas, const Earth& earth,
                             const LineClearance& line, const std::optional<FresnelClearance>& zone);

}  // namespace itin::profile
