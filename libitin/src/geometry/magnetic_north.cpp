#include <array>
#include <cmath>

#include <fmt/format.h>

#include <itin/degrees.hpp>
#include <itin/geodesic.hpp>
#include <itin/magnetic_north.hpp>

#include "geometry/wmm2025.hpp"

namespace itin {

namespace {

/// The radius to which the coefficients refer, metres.
constexpr double kReferenceRadius = 6371200;
/// The horizontal field, nT, below which declinations mean nothing: the model's blackout zones.
constexpr double kLeastHorizontal = 2000;

bool is_of_the_model(double year) {
  return year >= kMagneticFrom && year < kMagneticUntil;
}

/// A point in geocentric coordinates.
struct Geocentric {
  double radius_m;
  double sin_colatitude, cos_colatitude;
  double sin_turn, cos_turn;  ///< sine and cosine of the geocentric latitude less the geodetic one
};

Geocentric geocentric(double latitude, double height_m) {
  const double a = kWgs84.major_m, e2 = kWgs84.flattening * (2 - kWgs84.flattening);
  const double sine = std::sin(latitude), cosine = std::cos(latitude);
  const double normal = a / std::sqrt(1 - e2 * sine * sine);
  const double from_axis = (normal + height_m) * cosine, from_equator = (normal * (1 - e2) + height_m) * sine;
  const double radius = std::hypot(from_axis, from_equator);
  const double s = from_axis / radius, c = from_equator / radius;
  return {radius, s, c, c * cosine - s * sine, s * cosine + c * sine};
}

/// Schmidt semi-normalised Legendre functions of the colatitude's cosine. Functions of orders m > 0 are divided by the
/// colatitude's sine, so that nothing is divided by zero at the poles.
class Legendre {
 public:
  explicit Legendre(const Geocentric& p) : sine_(p.sin_colatitude), cosine_(p.cos_colatitude) {
    zonal_[0] = 1, zonal_[1] = cosine_;
    for (int n = 2; n <= kWmmDegree; ++n)
      zonal_[at(n)] = ((2 * n - 1) * cosine_ * zonal_[at(n - 1)] - (n - 1) * zonal_[at(n - 2)]) / n;
    for (int m = 1; m <= kWmmDegree; ++m) {
      over_sine(m, m) = m == 1 ? 1 : sine_ * std::sqrt((2 * m - 1) / (2.0 * m)) * over_sine(m - 1, m - 1);
      for (int n = m + 1; n <= kWmmDegree; ++n)
        over_sine(n, m) = ((2 * n - 1) * cosine_ * over_sine(n - 1, m) - root(n - 1, m) * below(n, m)) / root(n, m);
    }
  }

  double value(int n, int m) const { return m == 0 ? zonal_[at(n)] : sine_ * over_sine(n, m); }
  double over_sine(int n, int m) const { return over_sine_[at(n)][at(m)]; }
  /// Returns the derivative with respect to the colatitude.
  double derivative(int n, int m) const {
    if (m == 0) return -std::sqrt(n * (n + 1) / 2.0) * value(n, 1);
    return n * cosine_ * over_sine(n, m) - (n > m ? root(n, m) * over_sine(n - 1, m) : 0);
  }

 private:
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  static double root(int n, int m) { return std::sqrt(static_cast<double>(n * n - m * m)); }
  double& over_sine(int n, int m) { return over_sine_[at(n)][at(m)]; }
  double below(int n, int m) const { return n - 2 < m ? 0 : over_sine(n - 2, m); }

  double sine_, cosine_;
  std::array<double, kWmmDegree + 1> zonal_{};
  std::array<std::array<double, kWmmDegree + 1>, kWmmDegree + 1> over_sine_{};
};

}  // namespace

MagneticField magnetic_field(Point2 lon_lat, double height_m, double year) {
  const double longitude = in_radians(lon_lat.x);
  const Geocentric p = geocentric(in_radians(lon_lat.y), height_m);
  const Legendre legendre(p);
  double north = 0, east = 0, down = 0;  // geocentric
  for (const GaussCoefficients& c : kWmm2025) {
    const double g = c.g + c.g_rate * (year - kWmmEpoch), h = c.h + c.h_rate * (year - kWmmEpoch);
    const double cosine = std::cos(c.m * longitude), sine = std::sin(c.m * longitude);
    const double along = g * cosine + h * sine, across = g * sine - h * cosine;
    const double scale = std::pow(kReferenceRadius / p.radius_m, c.n + 2);
    north += scale * along * legendre.derivative(c.n, c.m);
    if (c.m > 0) east += scale * c.m * across * legendre.over_sine(c.n, c.m);
    down -= scale * (c.n + 1) * along * legendre.value(c.n, c.m);
  }
  return {north * p.cos_turn - down * p.sin_turn, east, north * p.sin_turn + down * p.cos_turn};
}

std::optional<double> declination_deg(Point2 lon_lat, double height_m, double year) {
  if (!is_of_the_model(year)) return std::nullopt;
  const MagneticField field = magnetic_field(lon_lat, height_m, year);
  if (std::hypot(field.north_nt, field.east_nt) < kLeastHorizontal) return std::nullopt;
  return in_degrees(std::atan2(field.east_nt, field.north_nt));
}

bool has_declination(const CalendarDay& day) {
  return is_of_the_model(decimal_year(day));
}

std::string magnetic_model_text() {
  return fmt::format("World Magnetic Model {} (NOAA/NCEI and BGS), epoch {:.1f}, valid from {:.1f} to {:.1f}",
                     kMagneticModel, kWmmEpoch, kMagneticFrom, kMagneticUntil);
}

}  // namespace itin
