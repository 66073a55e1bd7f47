// The losses of a line, at the points that a report takes.
#pragma once

#include <optional>

#include <profile/los.hpp>

namespace itin::profile {

/// `bare`: the ground under raised features, if there are any. Nothing without a frequency or a length, and where an
/// antenna is within a feature.
std::optional<PathLosses> losses_over(const Profile& profile, const Antennas& antennas, const LosQuery& query,
                                      const Profile* bare);

}  // namespace itin::profile
