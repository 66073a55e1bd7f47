// The line over the Earth that bulges most of those that criteria ask about.
#pragma once

#include <string>

#include <profile/los.hpp>

namespace itin::profile {

/// The criterion with the least K, where its Earth bulges more than the report's; null without one.
const CriterionResult* worst_fade(const LosReport& report);

/// "At K = 0.6667, where 0.3 F1 is wanted: fails by 1.65 F1 (4.81 m)."
std::string fade_line(const CriterionResult& fade);

/// What a drawing needs of the same line over that criterion's Earth; without criteria, losses and reflection, which
/// are the report's.
LosReport over_earth_of(const LosReport& report, const CriterionResult& fade);

}  // namespace itin::profile
