// How far a ray falls short of a fraction of the first Fresnel zone, in metres, and where most.
//
//   const auto lack = fresnel_lack(profile, antennas, earth, 0.6, wavelength_m(7.5));
//   if (lack) std::cout << lack->metres << " m at " << lack->distance_m << " m\n";
//
// The place is another than that of the least ratio to the zone's radius: near an end, where the zone is thin, a few
// metres are many radii.
#pragma once

#include <optional>

#include <itin/earth.hpp>
#include <profile/fresnel.hpp>
#include <profile/profile.hpp>

namespace itin::profile {

struct FresnelLack {
  double metres = 0;  ///< by how much the clearance is less than the fraction of the radius, > 0
  double distance_m = 0;
};

/// Returns where most is lacking over the known ground, to the rounding of distances; nothing where the fraction is
/// clear everywhere. O(n).
std::optional<FresnelLack> fresnel_lack(const Profile& profile, const Antennas& antennas, const Earth& earth,
                                        double fraction, double wavelength);

}  // namespace itin::profile
