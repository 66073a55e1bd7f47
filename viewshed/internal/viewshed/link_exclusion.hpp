// The area where a turbine's rotor would come into the second Fresnel zone of a radio link (D. F. Bacon, "Fixed-link
// wind-turbine exclusion zone method", Ofcom 2002).
//
//   const double clear = link_clearance_m(link, {x, y}, 7.5, 45);   // negative: excluded
//
// The method works in plan: it compares the zone's radius at the foot of the perpendicular from the turbine to the
// link, plus the rotor's, with the perpendicular's length. Heights do not count, so it is on the safe side where a
// rotor turns far above or below the beam.
#pragma once

#include <cstdint>
#include <vector>

#include <itin/geometry.hpp>
#include <itin/raster.hpp>
#include <viewshed/zone_files.hpp>

namespace itin::viewshed {

/// The zone's radius sqrt(2 lambda d1 d2 / (d1 + d2)), metres; lambda = 0.299792458 / f.
double second_fresnel_radius_m(double d1, double d2, double frequency_ghz);

/// Distance in plan, metres, between the second Fresnel zone and a rotor of that radius, which may face any way. Beyond
/// the link's ends the zone has shrunk to the end.
double link_clearance_m(const RadioLink& link, Point2 turbine, double frequency_ghz, double rotor_radius_m);

inline constexpr std::uint8_t kLinkClear = 0;
inline constexpr std::uint8_t kLinkExcluded = 1;
/// Returns one value per cell, decided at its centre.
std::vector<std::uint8_t> link_exclusion(const RasterGrid& grid, const std::vector<RadioLink>& links,
                                         double frequency_ghz, double rotor_radius_m);

}  // namespace itin::viewshed
