#include <cmath>

#include <fmt/format.h>

#include <itin/earth.hpp>
#include <itin/error.hpp>

namespace itin {

Earth Earth::flat() {
  Earth earth;
  earth.curvature = false;
  return earth;
}

Earth Earth::effective_earth(double factor) {
  Earth earth;
  earth.effective_factor = factor;
  return earth;
}

void Earth::validate() const {
  const auto positive = [](double v) { return std::isfinite(v) && v > 0; };
  if (!positive(radius))
    throw InputError(fmt::format("Earth radius {} m: give a positive number of metres, such as 6371000", radius),
                     "radius");
  if (effective_factor && !positive(*effective_factor))
    throw InputError(fmt::format("effective Earth factor {}: give a positive number, such as 4/3", *effective_factor),
                     "effective_factor");
  if (!std::isfinite(refraction) || refraction >= 1)
    throw InputError(fmt::format("refraction coefficient {}: give a number below 1, such as 0.13", refraction),
                     "refraction");
}

double Earth::drop_coefficient() const {
  if (!curvature) return 0;
  return effective_factor ? 1 / (2 * *effective_factor * radius) : (1 - refraction) / (2 * radius);
}

std::string Earth::convention() const {
  if (!curvature) return "no curvature, no refraction";
  if (effective_factor)
    return fmt::format("drop = d^2 / (2 K R), K = {:.6g}, R = {:.10g} m", *effective_factor, radius);
  return fmt::format("drop = d^2 (1 - k) / (2 R), k = {:.6g}, R = {:.10g} m", refraction, radius);
}

double effective_earth_km(const Earth& earth) {
  return 1 / (2 * earth.drop_coefficient()) / 1000;
}

}  // namespace itin
