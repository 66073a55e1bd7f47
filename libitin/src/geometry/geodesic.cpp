#include <cmath>

#include <itin/degrees.hpp>
#include <itin/error.hpp>
#include <itin/geodesic.hpp>

namespace itin {

namespace {

double azimuth(double y, double x) {
  const double degrees = in_degrees(std::atan2(y, x));
  return degrees < 0 ? degrees + 360 : degrees;
}

/// The state of Vincenty's iteration, in his letters.
struct Arc {
  double sin_sigma, cos_sigma, sigma, cos2_alpha, cos_2sigma_m, sin_alpha;
};

struct Reduced {
  double sin_u1, cos_u1, sin_u2, cos_u2;
};

Arc arc_for(const Reduced& r, double lambda) {
  Arc a{};
  const double across = r.cos_u2 * std::sin(lambda);
  const double along = r.cos_u1 * r.sin_u2 - r.sin_u1 * r.cos_u2 * std::cos(lambda);
  a.sin_sigma = std::hypot(across, along);
  a.cos_sigma = r.sin_u1 * r.sin_u2 + r.cos_u1 * r.cos_u2 * std::cos(lambda);
  a.sigma = std::atan2(a.sin_sigma, a.cos_sigma);
  a.sin_alpha = a.sin_sigma == 0 ? 0 : r.cos_u1 * r.cos_u2 * std::sin(lambda) / a.sin_sigma;
  a.cos2_alpha = 1 - a.sin_alpha * a.sin_alpha;
  a.cos_2sigma_m = a.cos2_alpha == 0 ? 0 : a.cos_sigma - 2 * r.sin_u1 * r.sin_u2 / a.cos2_alpha;
  return a;
}

double next_lambda(const Arc& a, double longitude_difference, double flattening) {
  const double c = flattening / 16 * a.cos2_alpha * (4 + flattening * (4 - 3 * a.cos2_alpha));
  const double m = a.cos_2sigma_m;
  return longitude_difference +
         (1 - c) * flattening * a.sin_alpha * (a.sigma + c * a.sin_sigma * (m + c * a.cos_sigma * (2 * m * m - 1)));
}

double length_of(const Arc& arc, const Ellipsoid& ellipsoid) {
  const double major = ellipsoid.major_m, minor = major * (1 - ellipsoid.flattening);
  const double u2 = arc.cos2_alpha * (major * major - minor * minor) / (minor * minor), m = arc.cos_2sigma_m;
  const double a = 1 + u2 / 16384 * (4096 + u2 * (-768 + u2 * (320 - 175 * u2)));
  const double b = u2 / 1024 * (256 + u2 * (-128 + u2 * (74 - 47 * u2)));
  const double correction = b * arc.sin_sigma *
                            (m + b / 4 *
                                     (arc.cos_sigma * (2 * m * m - 1) -
                                      b / 6 * m * (4 * arc.sin_sigma * arc.sin_sigma - 3) * (4 * m * m - 3)));
  return minor * a * (arc.sigma - correction);
}

}  // namespace

Geodesic geodesic(Point2 from, Point2 to, const Ellipsoid& ellipsoid) {
  if (from == to) return {};
  const double flat = 1 - ellipsoid.flattening;
  const double u1 = std::atan(flat * std::tan(in_radians(from.y)));
  const double u2 = std::atan(flat * std::tan(in_radians(to.y)));
  const Reduced r{std::sin(u1), std::cos(u1), std::sin(u2), std::cos(u2)};
  const double difference = in_radians(to.x - from.x);
  double lambda = difference;
  for (int i = 0; i < 100; ++i) {
    const Arc arc = arc_for(r, lambda);
    const double next = next_lambda(arc, difference, ellipsoid.flattening);
    const bool converged = std::abs(next - lambda) < 1e-13;
    lambda = next;
    if (!converged) continue;
    const double sine = std::sin(lambda), cosine = std::cos(lambda);
    return {length_of(arc_for(r, lambda), ellipsoid),
            azimuth(r.cos_u2 * sine, r.cos_u1 * r.sin_u2 - r.sin_u1 * r.cos_u2 * cosine),
            azimuth(-r.cos_u1 * sine, r.sin_u2 * r.cos_u1 * -cosine + r.cos_u2 * r.sin_u1)};
  }
  throw InputError("no direction between nearly antipodal points");
}

}  // namespace itin
