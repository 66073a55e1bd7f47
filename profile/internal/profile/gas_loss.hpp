// What oxygen and water vapour take from a radio wave.
//
//   const double lost_db = 12.4 * gas_loss(18).both_db_km();   // 12.4 km at 18 GHz, in standard air
//
// Source: ITU-R P.676-13 annex 1, line by line.
#pragma once

namespace itin::profile {

/// Air near the ground.
struct Air {
  double dry_hpa = 1013.25;  ///< the pressure of the dry air
  double temperature_k = 288.15;
  double water_g_m3 = 7.5;
};

/// The frequencies, GHz, that the formulas are for.
inline constexpr double kGasesFrom = 1, kGasesTo = 1000;

/// What is lost over a kilometre, in dB. The two gases add up.
struct GasLoss {
  double oxygen_db_km = 0, water_db_km = 0;

  double both_db_km() const { return oxygen_db_km + water_db_km; }
};
GasLoss gas_loss(double frequency_ghz, const Air& air = {});

}  // namespace itin::profile
