// The profile under a line of sight, with the ray and its Fresnel zone, for clients that draw it.
#pragma once

#include <itin/document.hpp>
#include <profile/los.hpp>

namespace itin::cli {

/// Lists of equal length, as PROTOCOL.md describes them. Where the profile has no breakpoint for long, places between
/// are added, since the ray and the zone are curved.
Document sight_profile(const profile::LosReport& report);

}  // namespace itin::cli
