#include <algorithm>
#include <array>

#include <itin/fresnel_zone.hpp>

namespace itin {

namespace {

/// The polynomial a t^3 + b t^2 + c t + d.
struct Cubic {
  double a, b, c, d;
  double at(double t) const { return ((a * t + b) * t + c) * t + d; }
};

/// Finds the root in [low, high], where the cubic is monotone, by bisection; nothing if the sign does not change.
std::optional<double> root_between(const Cubic& cubic, double low, double high) {
  const bool rising = cubic.at(low) < 0;
  if ((cubic.at(high) < 0) == rising) return std::nullopt;
  while (true) {
    const double middle = low + (high - low) / 2;
    if (middle <= low || middle >= high) return middle;
    ((cubic.at(middle) < 0) == rising ? low : high) = middle;
  }
}

/// Returns where the cubic is stationary, ascending; both are `from` where it is stationary nowhere.
std::array<double, 2> stationary_points(const Cubic& cubic, double from) {
  const double a = 3 * cubic.a, half_b = cubic.b, c = cubic.c;
  if (a == 0) {
    const double only = half_b == 0 ? from : -c / (2 * half_b);
    return {only, only};
  }
  const double discriminant = half_b * half_b - a * c;
  if (discriminant < 0) return {from, from};
  const double q = -(half_b + std::copysign(std::sqrt(discriminant), half_b));
  const double first = q / a, second = q == 0 ? first : c / q;
  return {std::min(first, second), std::max(first, second)};
}

}  // namespace

void LeastFraction::consider(double t, double clearance) {
  const double radius = unit_ * std::sqrt(t * (1 - t));
  if (radius == 0 && std::abs(clearance) > touching_) return;
  const double fraction = radius == 0 ? 0 : clearance / radius;
  if (!least_ || fraction < least_->fraction) least_ = Place{fraction, t, clearance};
}

/// Tells whether every ratio along the piece is certainly greater than the least one. Most pieces are so, and need no
/// root.
bool LeastFraction::is_greater_along(const ClearancePiece& p) const {
  if (!least_) return false;
  constexpr double kRounding = 1e-9;
  // A parabola sags no farther below its chord than this.
  const double sag = std::max(p.square, 0.0) * (p.to - p.from) * (p.to - p.from) / 4;
  const double uncertain = kRounding * (std::abs(p.constant) + std::abs(p.linear) + std::abs(p.square));
  const double lowest = std::min(p.at(p.from), p.at(p.to)) - sag - uncertain;
  const double least = least_->fraction * unit_;  // the clearance of that ratio where sqrt(t (1 - t)) is 1
  if (lowest >= 0) return least < 0 || lowest * lowest > (1 + kRounding) / 4 * least * least;
  const double narrowest = std::min(p.from * (1 - p.from), p.to * (1 - p.to));
  return least < 0 && (1 + kRounding) * lowest * lowest < least * least * narrowest;
}

/// The ratio is stationary where its numerator's and denominator's logarithmic derivatives agree. As the radius is
/// proportional to sqrt(t (1 - t)), these places are the roots of this cubic.
void LeastFraction::consider_inside(const ClearancePiece& p) {
  if (is_greater_along(p)) return;
  const Cubic cubic{-p.square, 1.5 * p.square, p.linear / 2 + p.constant, -p.constant / 2};
  const std::array<double, 2> stationary = stationary_points(cubic, p.from);
  const std::array<double, 4> bounds = {p.from, std::clamp(stationary[0], p.from, p.to),
                                        std::clamp(stationary[1], p.from, p.to), p.to};
  for (std::size_t i = 0; i + 1 < bounds.size(); ++i) {
    const auto root = root_between(cubic, bounds[i], bounds[i + 1]);
    if (root) consider(*root, p.at(*root));
  }
}

}  // namespace itin
