// What a link budget says in words.
//
//   for (const std::string& line : budget_lines(*report.budget)) std::cout << line << '\n';
#pragma once

#include <string>
#include <vector>

#include <profile/diffraction.hpp>

namespace itin::profile {

/// Returns "0.0021 %" or "at most 0.001 %".
std::string outage_text(const Outage& outage);
/// Returns "99.9979 %" or "at least 99.9990 %", with as many digits as tell two of the outage's.
std::string availability_text(const Availability& availability);
/// Returns "11.1 minutes a year" or "at most 5.3 minutes a year".
std::string minutes_text(const Availability& availability);
/// Tells that a path is too short for multipath: "none up to 5 km".
std::string no_multipath_text();
/// Names what the budget does not count: "rain (no rate is given); interference, ...".
std::string not_counted_text(const LinkBudget& budget);

/// Names what the radios of a budget have, without their frequency: "power 20 dBm, gain 17 dBi, gain of the receiver
/// 8 dBi, sensitivity -85 dBm".
std::string radios_text(const BudgetQuery& query);

/// Returns the budget as lines of text.
std::vector<std::string> budget_lines(const LinkBudget& budget);

}  // namespace itin::profile
