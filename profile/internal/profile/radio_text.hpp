// Frequencies and criteria as people write them, in calls and in tables.
#pragma once

#include <string>
#include <string_view>

#include <profile/los.hpp>

namespace itin::profile {

/// Reads a frequency and returns it in GHz: "7.5", "7.5 GHz", "7500MHz". Throws InputError, which says what is wrong,
/// for other text, and for frequencies below 1 MHz and above 300 GHz.
double parse_frequency_ghz(std::string_view text);

/// Reads K and the fraction of F1, "4/3:1.0" or "1.33:0.6"; "ke:0.3" stands for the K of the worst fade on the line.
/// Throws InputError.
Criterion parse_criterion(std::string_view text);
/// Writes K: "1.333", or "0.5657 (ke)" for the K of the worst fade.
std::string factor_text(const Criterion& criterion, double k);

/// Reads "h" or "v", or the words. Throws InputError.
Polarisation parse_polarisation(std::string_view text);

}  // namespace itin::profile
