// The straight pieces of ground under a line over a profile.
#pragma once

#include <cstddef>
#include <utility>

#include <itin/clearance.hpp>
#include <profile/fresnel.hpp>
#include <profile/profile.hpp>

namespace itin::profile {

/// Calls visit(ClearancePiece, i) for every two joined points i and i + 1 that are apart. The piece's distances are
/// fractions of the length. `drop` is Earth::drop_coefficient().
template <class Visit>
void for_each_piece(const Profile& profile, const Antennas& antennas, double drop, Visit visit) {
  const double length = profile.length_m;
  const LineOverGround line(antennas.from_m, antennas.to_m, 1, drop * length * length);
  for (std::size_t i = 0; i + 1 < profile.points.size(); ++i) {
    const ProfilePoint &a = profile.points[i], &b = profile.points[i + 1];
    if (b.distance_m <= a.distance_m || !profile.joined(i)) continue;
    visit(line.piece({a.distance_m / length, a.ground_m}, {b.distance_m / length, b.ground_m}), i);
  }
}

/// The ground at a distance that lies between those of point i and of the next.
inline ProfilePoint ground_between(const Profile& profile, std::size_t i, double distance_m) {
  const ProfilePoint &a = profile.points[i], &b = profile.points[i + 1];
  if (distance_m == a.distance_m) return a;
  if (distance_m == b.distance_m) return b;
  const double s = (distance_m - a.distance_m) / (b.distance_m - a.distance_m);
  ProfilePoint p = a.ground_m >= b.ground_m ? a : b;
  p.theme = profile.theme_between(i);
  p.distance_m = distance_m;
  p.x = a.x + (b.x - a.x) * s, p.y = a.y + (b.y - a.y) * s;
  p.ground_m = a.ground_m + (b.ground_m - a.ground_m) * s;
  return p;
}

}  // namespace itin::profile
