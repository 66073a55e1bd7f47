#include <algorithm>
#include <cmath>
#include <numbers>

#include <itin/smooth_path.hpp>

namespace itin {

double reflection_km(const SmoothPath& path, double effective_earth_km) {
  // An antenna on the surface reflects at its foot; close to the surface, rounding would lead beyond the path.
  if (path.from_m == 0) return 0;
  if (path.to_m == 0) return path.distance_km;
  const double sum = path.from_m + path.to_m, d = path.distance_km;
  const double c = (path.from_m - path.to_m) / sum, m = 250 * d * d / (effective_earth_km * sum);
  const double cosine = std::clamp(1.5 * c * std::sqrt(3 * m / std::pow(m + 1, 3)), -1.0, 1.0);
  const double b =
      m == 0 ? c : 2 * std::sqrt((m + 1) / (3 * m)) * std::cos(std::numbers::pi / 3 + std::acos(cosine) / 3);
  return d / 2 * (1 + std::clamp(b, -1.0, 1.0));
}

}  // namespace itin
