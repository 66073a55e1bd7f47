// What rain takes from a radio wave, and how much of the year it takes more than a link can spare.
//
//   const RainPath path{.frequency_ghz = 18, .polarisation = Polarisation::kVertical, .length_km = 9};
//   const RainLoss rain = rain_loss(path, 28);                    // 28 mm/h are exceeded for 0.01 % of the year
//   const std::optional<Outage> out = rain_outage(rain, 18, 32);  // with a margin of 32 dB
//
// Sources: ITU-R P.838-3 (specific attenuation), P.530-18 section 2.4.1 (long-term statistics), which is that of
// P.530-17.
#pragma once

#include <optional>

#include <profile/diffraction.hpp>

namespace itin::profile {

/// The ranges of the method: GHz, km, percent of the year.
inline constexpr double kRainFrom = 1, kRainTo = 100, kLongestInRain = 60, kLeastRain = 0.001, kMostRain = 1;

struct RainPath {
  double frequency_ghz = 0;
  Polarisation polarisation = Polarisation::kHorizontal;
  double length_km = 0;
  double elevation_rad = 0;  ///< the path's own angle
};

/// What is lost over a kilometre in rain of this rate, in dB, P.838-3 equations (1) to (5).
double rain_loss_db_km(const RainPath& path, double rate_mm_h);

/// What rain takes whose rate is exceeded for 0.01 % of an average year, P.530-18 equation (32).
RainLoss rain_loss(const RainPath& path, double rate_mm_h);

/// What is exceeded for `percent` of an average year, kLeastRain to kMostRain, P.530-18 equations (33) and (34).
double rain_exceeded_db(const RainLoss& rain, double frequency_ghz, double percent);

/// The part of the year in which rain takes more than the margin: at most kLeastRain where the margin is greater than
/// what is exceeded for that; nothing where it is less than what is exceeded for kMostRain.
std::optional<Outage> rain_outage(const RainLoss& rain, double frequency_ghz, double margin_db);

}  // namespace itin::profile
