// The `los` document of the contract, from a report.
#pragma once

#include <profile/los.hpp>

#include "program/verb.hpp"

namespace itin::cli {

Document end_document(const profile::LosEnd& end);

/// `distance_m`, `verdict`, `known_verdict`, `clearance_m`, `critical`, `tightest`, `obstructions`, `criteria`,
/// `required_heights`, likewise in `bare` for the ground without its clutter; `radio`, `visible_height`, `gaps`,
/// `gap_m`. Positions are null in a profile without any.
Document los_document(const profile::LosReport& report);

}  // namespace itin::cli
