// One straight piece of ground under a ray: the clearance as a quadratic of the relative distance.
#pragma once

#include <cstddef>
#include <utility>

#include <profile/fresnel.hpp>
#include <profile/profile.hpp>

namespace itin::profile {

/// With t = distance / length in [from, to]: ray - ground - bulge = constant + linear t + square t^2.
struct RayPiece {
  double from = 0, to = 0;
  double constant = 0, linear = 0, square = 0;

  double at(double t) const { return constant + t * (linear + t * square); }
};

/// Calls visit(RayPiece, i) for every two joined points i, i + 1 that are apart. `drop` is Earth::drop_coefficient().
template <class Visit>
void for_each_piece(const Profile& profile, const Antennas& antennas, double drop, Visit visit) {
  const double length = profile.length_m;
  // The bulge drop d (L - d) is drop L^2 (t - t^2).
  const double bulge = drop * length * length;
  for (std::size_t i = 0; i + 1 < profile.points.size(); ++i) {
    const ProfilePoint &a = profile.points[i], &b = profile.points[i + 1];
    if (b.distance_m <= a.distance_m || !profile.joined(i)) continue;
    RayPiece piece{a.distance_m / length, b.distance_m / length};
    const double slope = (b.ground_m - a.ground_m) / (piece.to - piece.from);
    piece.constant = antennas.from_m - (a.ground_m - slope * piece.from);
    piece.linear = antennas.to_m - antennas.from_m - slope - bulge;
    piece.square = bulge;
    visit(piece, i);
  }
}

}  // namespace itin::profile
