// Frequencies and criteria as people write them, in calls and in tables.
#pragma once

#include <string>
#include <string_view>

#include <profile/los.hpp>

namespace itin::profile {

/// GHz: "7.5", "7.5 GHz", "7500MHz". Throws InputError, which says what is wrong with the text, also for a number
/// without a unit that would be beyond all radio.
double parse_frequency_ghz(std::string_view text);

/// "4/3:1.0" or "1.33:0.6": K and the fraction of F1; "ke:0.3": with the K of the worst fade on the line. Throws
/// InputError.
Criterion parse_criterion(std::string_view text);
/// "1.333", or "0.5657 (ke)" of the worst fade.
std::string factor_text(const Criterion& criterion, double k);

/// "h" or "v", or the words. Throws InputError.
Polarisation parse_polarisation(std::string_view text);

}  // namespace itin::profile
