// The straight pieces of ground under a ray over a profile.
#pragma once

#include <cstddef>
#include <utility>

#include <itin/fresnel_zone.hpp>
#include <profile/fresnel.hpp>
#include <profile/profile.hpp>

namespace itin::profile {

/// Calls visit(RayPiece, i) for every two joined points i, i + 1 that are apart. `drop` is Earth::drop_coefficient().
template <class Visit>
void for_each_piece(const Profile& profile, const Antennas& antennas, double drop, Visit visit) {
  const double length = profile.length_m;
  const RayOverGround ray{antennas.from_m, antennas.to_m, drop * length * length};
  for (std::size_t i = 0; i + 1 < profile.points.size(); ++i) {
    const ProfilePoint &a = profile.points[i], &b = profile.points[i + 1];
    if (b.distance_m <= a.distance_m || !profile.joined(i)) continue;
    visit(ray.piece(a.distance_m / length, a.ground_m, b.distance_m / length, b.ground_m), i);
  }
}

}  // namespace itin::profile
