#include "lines/losses.hpp"

#include <itin/diffraction.hpp>

namespace itin::profile {

std::optional<PathLosses> losses_over(const Profile& profile, const Antennas& antennas, const LosQuery& query,
                                      const Profile* bare) {
  if (!query.radio || !profile.has_length()) return std::nullopt;
  const EndGrounds top = ends_of(profile);
  if (antennas.from_m < top.from_m || antennas.to_m < top.to_m) return std::nullopt;
  if (query.points_as_given) return path_losses(profile, antennas, *query.radio, bare);
  return path_losses(with_spacing(profile, greatest_spacing_m(profile.length_m)), antennas, *query.radio, bare);
}

}  // namespace itin::profile
