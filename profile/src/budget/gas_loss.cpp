#include <cmath>

#include <profile/gas_loss.hpp>

#include "budget/gas_lines.hpp"

namespace itin::profile {

namespace {

/// The air in the terms of the formulas: theta = 300 / T, and the pressures of dry air and of vapour in hPa.
struct AirTerms {
  double theta, p, e;
};

AirTerms terms_of(const Air& air) {
  return {300 / air.temperature_k, air.dry_hpa, air.water_g_m3 * air.temperature_k / 216.7};
}

/// The shape of a line of a width, with the correction for interference among lines, equation (5).
double line_shape(double f, double f0, double width, double correction) {
  const auto half = [&](double away) { return (width - correction * away) / (away * away + width * width); };
  return f / f0 * (half(f0 - f) + half(f0 + f));
}

/// The strength of a line, equation (3), times its shape. The width, equation (6), includes Zeeman's splitting.
double oxygen_line(double f, const OxygenLine& line, const AirTerms& air) {
  const auto& [theta, p, e] = air;
  const double strength = line.a1 * 1e-7 * p * std::pow(theta, 3) * std::exp(line.a2 * (1 - theta));
  const double plain_width = line.a3 * 1e-4 * (p * std::pow(theta, 0.8) + 1.1 * e * theta);
  const double width = std::sqrt(plain_width * plain_width + 2.25e-6);
  const double correction = (line.a5 + line.a6 * theta) * 1e-4 * (p + e) * std::pow(theta, 0.8);
  return strength * line_shape(f, line.f0, width, correction);
}

/// The strength of a line of water vapour times its shape. The width includes Doppler's broadening.
double water_line(double f, const WaterLine& line, const AirTerms& air) {
  const auto& [theta, p, e] = air;
  const double strength = line.b1 * 1e-1 * e * std::pow(theta, 3.5) * std::exp(line.b2 * (1 - theta));
  const double plain_width = line.b3 * 1e-4 * (p * std::pow(theta, line.b4) + line.b5 * e * std::pow(theta, line.b6));
  const double doppler = 2.1316e-12 * line.f0 * line.f0 / theta;
  const double width = 0.535 * plain_width + std::sqrt(0.217 * plain_width * plain_width + doppler);
  return strength * line_shape(f, line.f0, width, 0);
}

/// The part of dry air that belongs to no line, equations (8) and (9).
double dry_continuum(double f, const AirTerms& air) {
  const auto& [theta, p, e] = air;
  const double width = 5.6e-4 * (p + e) * std::pow(theta, 0.8);
  return f * p * theta * theta *
         (6.14e-5 / (width * (1 + std::pow(f / width, 2))) +
          1.4e-12 * p * std::pow(theta, 1.5) / (1 + 1.9e-5 * std::pow(f, 1.5)));
}

}  // namespace

GasLoss gas_loss(double frequency_ghz, const Air& air) {
  const AirTerms terms = terms_of(air);
  double oxygen = dry_continuum(frequency_ghz, terms), water = 0;
  for (const OxygenLine& line : kOxygenLines) oxygen += oxygen_line(frequency_ghz, line, terms);
  for (const WaterLine& line : kWaterLines) water += water_line(frequency_ghz, line, terms);
  return {0.182 * frequency_ghz * oxygen, 0.182 * frequency_ghz * water};  // equation (1)
}

}  // namespace itin::profile
