// P.452-17 sections 4.2.2 and 4.2.2.1; equation numbers are those of that recommendation.
#include <algorithm>
#include <cmath>

#include <itin/diffraction.hpp>
#include <itin/smooth_path.hpp>

namespace itin {

namespace {

struct Terrain {
  double permittivity;  ///< relative
  double conductivity;  ///< S/m
};
constexpr Terrain kLand{22, 0.003}, kSea{80, 5};

/// Returns the normalised surface admittance: equations (30a, 30b).
double admittance(const Terrain& terrain, double radius_km, const RadioPath& path) {
  const double loss = 18 * terrain.conductivity / path.frequency_ghz;
  const double horizontal = 0.036 * std::pow(radius_km * path.frequency_ghz, -1.0 / 3) *
                            std::pow(std::pow(terrain.permittivity - 1, 2) + loss * loss, -0.25);
  if (path.polarisation == Polarisation::kHorizontal) return horizontal;
  return horizontal * std::sqrt(terrain.permittivity * terrain.permittivity + loss * loss);
}

/// Returns the parameter beta of the surface: equation (31).
double surface_parameter(double k) {
  const double k2 = k * k, k4 = k2 * k2;
  return (1 + 1.6 * k2 + 0.67 * k4) / (1 + 4.5 * k2 + 1.53 * k4);
}

/// Returns the distance term: equation (34).
double distance_term(double x) {
  if (x >= 1.6) return 11 + 10 * std::log10(x) - 17.6 * x;
  return -20 * std::log10(x) - 5.6488 * std::pow(x, 1.425);
}

/// Returns the height gain: equations (35) and (36), with the limit below them.
double height_gain(double y, double beta, double k) {
  const double b = beta * y;
  const double gain =
      b > 2 ? 17.6 * std::sqrt(b - 1.1) - 5 * std::log10(b - 1.1) - 8 : 20 * std::log10(b + 0.1 * b * b * b);
  return std::max(gain, 2 + 20 * std::log10(k));
}

/// Returns the loss over one kind of terrain: equation (37).
double first_term(const Terrain& terrain, const SmoothPath& smooth, double radius_km, const RadioPath& path) {
  const double k = admittance(terrain, radius_km, path), beta = surface_parameter(k);
  const double x = 21.88 * beta * std::cbrt(path.frequency_ghz / (radius_km * radius_km)) * smooth.distance_km;
  const double y_unit = 0.9575 * beta * std::cbrt(path.frequency_ghz * path.frequency_ghz / radius_km);
  return -distance_term(x) - height_gain(y_unit * smooth.from_m, beta, k) - height_gain(y_unit * smooth.to_m, beta, k);
}

/// Returns the loss over land and sea: equation (29).
double first_term(const SmoothPath& smooth, double radius_km, const RadioPath& path) {
  double loss = 0;
  if (path.over_sea > 0) loss += path.over_sea * first_term(kSea, smooth, radius_km, path);
  if (path.over_sea < 1) loss += (1 - path.over_sea) * first_term(kLand, smooth, radius_km, path);
  return loss;
}

/// Returns the least clearance of a path within the horizon over a smooth Earth, as a part of the clearance for no
/// loss: equations (24) to (26). An antenna on the surface has no clearance.
double cleared_part(const SmoothPath& s, const RadioPath& path) {
  const double radius = path.effective_earth_km, d = s.distance_km;
  const double d1 = reflection_km(s, radius), d2 = d - d1;
  const double least = ((s.from_m - 500 * d1 * d1 / radius) * d2 + (s.to_m - 500 * d2 * d2 / radius) * d1) / d;
  const double required = 17.456 * std::sqrt(d1 * d2 * wavelength_m(path.frequency_ghz) / d);
  return required > 0 ? least / required : 0;
}

}  // namespace

double spherical_earth_db(double distance_km, double from_height_m, double to_height_m, const RadioPath& path) {
  const SmoothPath smooth{distance_km, from_height_m, to_height_m};
  const double roots = std::sqrt(from_height_m) + std::sqrt(to_height_m);
  const double horizon_km = std::sqrt(2 * path.effective_earth_km) * std::sqrt(0.001) * roots;  // equation (23)
  if (distance_km >= horizon_km) return first_term(smooth, path.effective_earth_km, path);
  const double cleared = cleared_part(smooth, path);
  if (cleared > 1) return 0;
  const double grazing_radius_km = 500 * std::pow(distance_km / roots, 2);  // equation (27)
  const double loss = first_term(smooth, grazing_radius_km, path);
  return loss < 0 ? 0 : (1 - cleared) * loss;  // equation (28)
}

}  // namespace itin
