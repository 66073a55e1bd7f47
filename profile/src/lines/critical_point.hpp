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

/// Where the ray is cut deepest, as `line` has it. If it is free, where `zone`, its tightest place of any wavelength,
/// is; the ends, where the least clearance is that of an antenna over its own foot, are so never meant. O(log n).
CriticalPoint critical_point(const Profile& profile, const Antennas& antennas, const Earth& earth,
                             const LineClearance& line, const std::optional<FresnelClearance>& zone);

}  // namespace itin::profile
