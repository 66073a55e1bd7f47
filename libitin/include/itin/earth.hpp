// Earth curvature and refraction, as one parabola, and ground without data, for sight lines; and what radio waves over
// the Earth need besides.
//
//   const Earth earth;                                         // curved, k = 0.13, R = 6371 km
//   const double light = earth.drop(40000);                    // 109.2 m
//   const Earth radio = Earth::effective_earth(4.0 / 3);       // radio.drop(40000): 94.2 m
//   const RadioPath path{.frequency_ghz = 7.5, .effective_earth_km = effective_earth_km(radio)};
//   const double wavelength = wavelength_m(path.frequency_ghz);   // 0.03997 m
//
// A point at horizontal distance d from the observer appears lower by drop = d^2 (1 - k) / (2 R), or by d^2 / (2 K R)
// with the effective Earth factor K = 1 / (1 - k). The parabola departs from the sphere by less than d^4 / (8 R^3):
// 1.2 mm at 40 km, 0.8 m at 200 km.
#pragma once

#include <optional>
#include <string>

namespace itin {

struct Earth {
  bool curvature = true;
  double refraction = 0.13;                     ///< coefficient k; ignored when effective_factor is given
  double radius = 6371000;                      ///< metres
  std::optional<double> effective_factor = {};  ///< radio's K

  static Earth flat();
  static Earth effective_earth(double factor);

  /// Throws InputError unless the radius and the factor (where given) are positive, k is below 1, and all are finite.
  /// From k = 1 on, sight lines would bend as much as the Earth, and there would be no horizon.
  void validate() const;
  /// Returns what the square of a distance is multiplied by to give the drop there, 1/m; 0 without curvature.
  double drop_coefficient() const;
  /// The drop at a distance, both metres.
  double drop(double distance) const { return drop_coefficient() * distance * distance; }
  /// One line for results, for example "drop = d^2 (1 - k) / (2 R), k = 0.13, R = 6371000 m".
  std::string convention() const;
};

/// What ground without data does to sight lines across it.
enum class NoData {
  kUnknown,  ///< sight lines across it are undecided, unless known ground hides them
  kBlock,    ///< no sight line passes: the edge of the surface is a curtain up to the sky
  kClear     ///< sight lines pass
};

/// Returns the radius, km, of the Earth over which rays are straight; infinity without curvature.
double effective_earth_km(const Earth& earth);

/// The speed of light, metres times GHz.
inline constexpr double kSpeedOfLight = 0.299792458;

/// The wavelength, metres.
constexpr double wavelength_m(double frequency_ghz) {
  return kSpeedOfLight / frequency_ghz;
}

enum class Polarisation { kHorizontal, kVertical };

struct RadioPath {
  double frequency_ghz = 0;          ///< > 0
  double effective_earth_km = 8500;  ///< effective radius ae; > 0, infinity for a flat Earth
  Polarisation polarisation = Polarisation::kHorizontal;
  double over_sea = 0;  ///< share of the path, 0 to 1
};

}  // namespace itin
