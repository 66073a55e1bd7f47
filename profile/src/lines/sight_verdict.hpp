// Gives the verdict on a clearance, by one rule for one line and for many.
#pragma once

#include <cmath>
#include <optional>

#include <itin/grazing.hpp>
#include <profile/los.hpp>

namespace itin::profile {

/// The verdict over known ground alone. A clearance nearer to 0 than `error_m` leaves it open.
inline SightVerdict known_verdict(const Profile& profile, const std::optional<double>& clearance_m, double error_m) {
  if (!profile.has_length() || !clearance_m) return SightVerdict::kVisible;
  if (std::abs(*clearance_m) < error_m) return SightVerdict::kUndecided;
  return *clearance_m >= -kGrazing ? SightVerdict::kVisible : SightVerdict::kHidden;
}

inline SightVerdict sight_verdict(const Profile& profile, SightVerdict known, NoData nodata) {
  const bool whole = profile.gaps.empty() || !profile.has_length();
  if (whole || known == SightVerdict::kHidden || nodata == NoData::kClear) return known;
  return nodata == NoData::kBlock ? SightVerdict::kHidden : SightVerdict::kUndecided;
}

}  // namespace itin::profile
