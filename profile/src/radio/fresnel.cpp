#include <cmath>

#include <itin/fresnel_zone.hpp>
#include <itin/grazing.hpp>
#include <profile/fresnel.hpp>

#include "lines/ground_pieces.hpp"

namespace itin::profile {

double fresnel_radius_m(double d1_m, double d2_m, double wavelength) {
  return d1_m + d2_m > 0 ? std::sqrt(wavelength * d1_m * d2_m / (d1_m + d2_m)) : 0;
}

std::optional<FresnelClearance> fresnel_clearance(const Profile& profile, const Antennas& antennas, const Earth& earth,
                                                  double wavelength) {
  const double length = profile.length_m;
  if (!profile.has_length()) return std::nullopt;
  LeastFraction tightest(std::sqrt(wavelength * length), kGrazing);
  const LineOverGround line(antennas.from_m, antennas.to_m, 1, earth.drop_coefficient() * length * length);
  for (const ProfilePoint& p : profile.points) {
    const double t = p.distance_m / length;
    tightest.consider(t, line.clearance({t, p.ground_m}));
  }
  for_each_piece(profile, antennas, earth.drop_coefficient(),
                 [&](const ClearancePiece& piece, std::size_t) { tightest.consider_inside(piece); });
  if (!tightest.least()) return std::nullopt;
  return FresnelClearance{tightest.least()->fraction, tightest.least()->t * length, tightest.least()->clearance};
}

}  // namespace itin::profile
