// Finds the line over the Earth that bulges most among the Earths that criteria ask about.
#pragma once

#include <string>

#include <profile/los.hpp>
#include <profile/report_text.hpp>

namespace itin::profile {

/// The criterion with the least K, if its Earth bulges more than the report's; null if there is none.
const CriterionResult* worst_fade(const LosReport& report);

/// Tells about it: "At K = 0.6667, where 0.3 F1 is wanted: fails by 4.81 m at 5.021 km; least ..."
std::string fade_line(const CriterionResult& fade, DistanceUnit unit);

/// Returns what a drawing needs for the same line over that criterion's Earth. It has no criteria, losses and
/// reflection, which belong to the report's Earth.
LosReport over_earth_of(const LosReport& report, const CriterionResult& fade);

}  // namespace itin::profile
