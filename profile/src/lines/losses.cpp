#include "lines/losses.hpp"

#include <algorithm>

namespace itin::profile {

namespace {

/// Formulas that look at points only see the profile at least this finely.
constexpr double kMostSpacingM = 100;
constexpr int kLeastPoints = 50;

}  // namespace

std::optional<PathLosses> losses_over(const Profile& profile, const Antennas& antennas, const LosQuery& query,
                                      const Profile* bare) {
  if (!query.radio || !profile.has_length()) return std::nullopt;
  const EndGrounds top = ends_of(profile);
  if (antennas.from_m < top.from_m || antennas.to_m < top.to_m) return std::nullopt;
  if (query.points_as_given) return path_losses(profile, antennas, *query.radio, bare);
  const double spacing = std::min(kMostSpacingM, profile.length_m / kLeastPoints);
  return path_losses(with_spacing(profile, spacing), antennas, *query.radio, bare);
}

}  // namespace itin::profile
