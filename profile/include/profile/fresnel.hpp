// Fresnel zones of a radio path, and how much of the first zone is clear over the whole path.
//
//   const double wavelength = profile::wavelength_m(7.5);                       // 0.03997 m at 7.5 GHz
//   const double radius = profile::fresnel_radius_m(4000, 6000, wavelength);    // 9.8 m
//   const auto least = profile::fresnel_clearance(line, {120.5, 98.0}, Earth(), wavelength);
//   if (least && least->fraction < 0.6) std::cout << "cut at " << least->distance_m << " m\n";
//
// Source: ITU-R P.526-15 section 2 (Fresnel ellipsoids), P.530-18 section 2.2 (clearance). The speed of light is the
// exact one: the radius is 17.314 sqrt(d1 d2 / (f d)) metres with km and GHz, not 17.3. Nothing is sampled: between two
// points of the profile the clearance is a quadratic of the distance, and its least ratio to the radius is at a root of
// a cubic.
#pragma once

#include <optional>

#include <itin/earth.hpp>
#include <profile/profile.hpp>

namespace itin::profile {

using itin::kSpeedOfLight;
using itin::wavelength_m;

/// Radius of the first Fresnel zone at distances d1 and d2 from the ends, all in metres: sqrt(lambda d1 d2 / (d1 +
/// d2)).
double fresnel_radius_m(double d1_m, double d2_m, double wavelength);

/// Elevations of a path's two antennas, metres.
struct Antennas {
  double from_m = 0;
  double to_m = 0;
};

/// The tightest place of the path, relative to the first Fresnel zone.
struct FresnelClearance {
  double fraction = 0;     ///< clearance / F1
  double distance_m = 0;   ///< distance of the place from the first end
  double clearance_m = 0;  ///< clearance at the place
};

/// Returns the least clearance / F1 between the ends. At the ends the radius is 0: a clearance of 0 counts as 0 there,
/// and any other is passed over. Nothing where the path has no length or no ground between its ends. O(n).
std::optional<FresnelClearance> fresnel_clearance(const Profile& profile, const Antennas& antennas, const Earth& earth,
                                                  double wavelength);

}  // namespace itin::profile
