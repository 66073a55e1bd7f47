// Finds what stands in the way of a ray over a profile.
#pragma once

#include <vector>

#include <itin/earth.hpp>
#include <profile/fresnel.hpp>
#include <profile/los.hpp>
#include <profile/profile.hpp>

#include "lines/line_clearance.hpp"

namespace itin::profile {

/// Returns the obstructions in order of distance. `least` is the ray's line_clearance(). Where it cuts the ray there is
/// at least one obstruction, and where it does not there is none. Over a piece of ground an obstruction begins and ends
/// at the roots of a quadratic. O(n).
std::vector<Obstruction> obstructions(const Profile& profile, const Antennas& antennas, const Earth& earth,
                                      const LineClearance& least);

}  // namespace itin::profile
