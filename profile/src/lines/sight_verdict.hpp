// The verdict on a clearance, by one rule for one line and for many.
#pragma once

#include <cmath>
#include <optional>

#include <itin/grazing.hpp>
#include <profile/los.hpp>

namespace itin::profile {

struct VerdictTerms {
  double clearance_error_m = 0;  ///< a clearance nearer to 0 leaves it open
  bool gaps_block = false;       ///< ground without data stops the ray
};

inline SightVerdict sight_verdict(const Profile& profile, const std::optional<double>& clearance_m,
                                  const VerdictTerms& terms) {
  if (!profile.has_length()) return SightVerdict::kVisible;
  if (terms.gaps_block && !profile.gaps.empty()) return SightVerdict::kHidden;
  if (!clearance_m) return SightVerdict::kVisible;
  if (std::abs(*clearance_m) < terms.clearance_error_m) return SightVerdict::kUndecided;
  return *clearance_m >= -kGrazing ? SightVerdict::kVisible : SightVerdict::kHidden;
}

}  // namespace itin::profile
