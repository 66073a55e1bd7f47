// How low and how high a triangle is within squares of one size, as far as its plane reaches within the square, and no
// farther than its corners do.
//
//   const TriangleSlope slope(tin, triangle, half);
//   const double middle = slope.middle(x, y);          // at the square's middle, grid units
//   use(slope.low(middle), slope.high(middle));
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <itin/tin.hpp>

namespace itin::viewshed {

class TriangleSlope {
 public:
  /// `half` is half the side of a square, with what lies beside it as well; grid units.
  TriangleSlope(const Tin& tin, std::uint32_t triangle, double half) {
    const auto [a, b, c] = tin.corners(triangle);
    least_ = std::min({a.z, b.z, c.z}), greatest_ = std::max({a.z, b.z, c.z});
    corner_ = {static_cast<double>(a.x), static_cast<double>(a.y), static_cast<double>(a.z)};
    const double bx = 1.0 * b.x - a.x, by = 1.0 * b.y - a.y, bz = 1.0 * b.z - a.z;
    const double cx = 1.0 * c.x - a.x, cy = 1.0 * c.y - a.y, cz = 1.0 * c.z - a.z;
    const double doubled_area = bx * cy - by * cx;
    is_plane_ = doubled_area != 0;
    if (!is_plane_) return;
    x_ = (bz * cy - by * cz) / doubled_area, y_ = (bx * cz - bz * cx) / doubled_area;
    // Rounding is far less than the last two terms.
    spread_ = (std::abs(x_) + std::abs(y_)) * half * (1 + 1e-6) + 1e-9 * (greatest_ - least_) + 1e-3;
  }

  /// The plane's height.
  double middle(double x, double y) const { return corner_.z + x_ * (x - corner_.x) + y_ * (y - corner_.y); }
  double low(double middle) const { return is_plane_ ? std::max(least_, middle - spread_) : least_; }
  double high(double middle) const { return is_plane_ ? std::min(greatest_, middle + spread_) : greatest_; }

 private:
  Point3 corner_;
  bool is_plane_ = false;
  double x_ = 0, y_ = 0, spread_ = 0;
  double least_ = 0, greatest_ = 0;
};

}  // namespace itin::viewshed
