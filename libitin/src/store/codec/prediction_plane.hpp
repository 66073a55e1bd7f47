// The arithmetic of predicted heights, as FORMAT.md gives it: a weighted least-squares plane through samples, with its
// slope damped. `Number` is double, or a vector of the numbers of several points.
//
// Encoder and decoder must come to the same number to the last bit on every machine. All sums are integers that their
// type holds exactly, in whatever order they are added up; the operations after them are IEEE 754, each rounded to
// nearest (never compile with contraction or fast-math).
#pragma once

#include <array>
#include <cstddef>

namespace itin {

/// The place of a bucket whose latest sample is used, counted from the point's own bucket.
struct BucketOffset {
  int x, y;
};
inline constexpr std::array<BucketOffset, 8> kBucketsAround = {
    {{0, 0}, {-1, 0}, {0, -1}, {-1, -1}, {1, -1}, {-1, 1}, {-2, 0}, {0, -2}}};

/// A sample's weight is this, divided by 1 more than the square of its distance, rounded down.
inline constexpr int kGreatestWeight = 65536;
constexpr int weight_at(int dx, int dy) {
  return kGreatestWeight / (dx * dx + dy * dy + 1);
}

/// Weighted sums over the samples' offsets from the point.
template <class Number>
struct PlaneMoments {
  Number w{}, x{}, y{}, xx{}, xy{}, yy{};

  constexpr void add(const Number& weight, const Number& dx, const Number& dy) {
    const Number wx = weight * dx, wy = weight * dy;
    w += weight, x += wx, y += wy;
    xx += wx * dx, xy += wx * dy, yy += wy * dy;
  }
};

/// Weighted sums with the samples' heights.
struct HeightMoments {
  double z = 0, xz = 0, yz = 0;

  void add(double weight, double dx, double dy, double dz) {
    const double wz = weight * dz;
    z += wz, xz += wz * dx, yz += wz * dy;
  }
};

/// The part of the plane that depends on the samples' offsets alone.
template <class Number>
struct PredictionPlane {
  Number w, x, y, a, c, cross, determinant;

  constexpr explicit PredictionPlane(const PlaneMoments<Number>& m)
      : w(m.w), x(m.x), y(m.y), cross(m.xy * m.w - m.x * m.y) {
    const Number spread_x = m.xx * m.w - m.x * m.x, spread_y = m.yy * m.w - m.y * m.y;
    const Number damping = (spread_x + spread_y) * 0.125;
    a = spread_x + damping, c = spread_y + damping;
    determinant = a * c - cross * cross;
  }

  /// Returns the plane's height at the point.
  double intercept(const HeightMoments& m) const {
    if (!(determinant > 0)) return m.z / w;
    const double e = m.xz * w - m.z * x, f = m.yz * w - m.z * y;
    const double slope_x = e * c - f * cross, slope_y = a * f - cross * e;
    return (m.z - (slope_x * x + slope_y * y) / determinant) / w;
  }
};

/// The shares of the samples in the plane's height at the point, which is the sum of each sample's share times its
/// height.
template <class Number>
class SampleShares {
 public:
  constexpr explicit SampleShares(const PredictionPlane<Number>& p) {
    // Without slope or samples the dividends are 0, and the quotients must be 0, too.
    const Number inverse = 1 / (p.determinant + kTiny);
    east_ = (p.c * p.x - p.cross * p.y) * inverse, north_ = (p.a * p.y - p.cross * p.x) * inverse;
    level_ = (1 + east_ * p.x + north_ * p.y) / (p.w + kTiny);
  }

  /// Finds the share of the sample with this weight at this offset.
  constexpr void find(Number& share, const Number& weight, const Number& dx, const Number& dy) const {
    share = weight * (level_ - east_ * dx - north_ * dy);
  }

 private:
  static constexpr double kTiny = 1e-300;  // changes nothing but 0
  Number level_, east_, north_;
};

}  // namespace itin
