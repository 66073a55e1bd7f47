// What radio waves lose in woods, by the curve of ITU-R P.833 section 2.1: A = Am (1 - exp(-d g / Am)).
//
//   if (const auto db = wood_loss_db(949, 50)) std::cout << *db << " dB\n";   // 7.27 dB
#pragma once

#include <optional>

namespace itin {

/// Returns the loss, dB, over d metres of wood; nothing for frequencies outside 105.9 to 2117.5 MHz. The specific
/// attenuation g and the greatest attenuation Am come from secondary sources: 0.04, 0.12, 0.17, 0.30, 0.34 dB/m
/// and 9.4, 18, 26.5, 29, 34.1 dB at 105.9, 466.475, 949, 1852.2 and 2117.5 MHz. Between these they are interpolated in
/// the logarithms. Precondition: metres is not negative.
std::optional<double> wood_loss_db(double frequency_mhz, double metres);

}  // namespace itin
