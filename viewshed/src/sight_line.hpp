// The exact side of a viewshed: whether one triangle rises above one sight line, in double precision.
//
// Coordinates are grid units (whole numbers at vertices). Along a line from `from` to `to`, at the fraction s of its
// length d, the Earth's curvature raises the ground against the straight line by c d^2 s (1 - s), for drop = c d^2.
// A triangle's section by the line's vertical plane is a straight piece, so the highest point of the ground over it is
// at one of its ends or at the vertex of a parabola.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include <itin/geometry.hpp>
#include <itin/grazing.hpp>

namespace itin::viewshed {

class SightLine {
 public:
  /// In grid units; `drop` is the drop's coefficient a grid unit, `grazing` is kGrazing in grid units.
  SightLine(const Point3& from, const Point3& to, double drop, double grazing)
      : from_(from), dx_(to.x - from.x), dy_(to.y - from.y), dz_(to.z - from.z), grazing_(grazing) {
    const double squared = dx_ * dx_ + dy_ * dy_;
    per_squared_length_ = 1 / squared;
    bulge_ = drop * squared;
  }

  /// Whether the triangle hides the one end from the other. Precondition: the ends differ horizontally.
  bool hidden_by(const GridPoint& a, const GridPoint& b, const GridPoint& c) const {
    const std::array<Corner, 3> corners{corner(a), corner(b), corner(c)};
    double low = 2, high = -1, low_rise = 0, high_rise = 0;
    const auto section = [&](double along, double rise) {
      if (along < low) low = along, low_rise = rise;
      if (along > high) high = along, high_rise = rise;
    };
    // Triangles are closed: an edge or a corner that only touches the line belongs to the section.
    for (std::size_t i = 0; i < 3; ++i) {
      const Corner &p = corners[i], &q = corners[i == 2 ? 0 : i + 1];
      if (p.side == 0) section(p.along, p.rise);
      if ((p.side < 0) == (q.side < 0) || p.side == 0 || q.side == 0) continue;
      const double w = p.side / (p.side - q.side);
      section(p.along + w * (q.along - p.along), p.rise + w * (q.rise - p.rise));
    }
    if (low > 1 || high < 0) return false;
    return highest(low, low_rise, high, high_rise) > grazing_;
  }

 private:
  struct Corner {
    double side;   ///< to which side of the line, times its length
    double along;  ///< fraction of the line's length
    double rise;   ///< above the straight line
  };

  Corner corner(const GridPoint& p) const {
    const double x = p.x - from_.x, y = p.y - from_.y;
    const double along = (x * dx_ + y * dy_) * per_squared_length_;
    return {dx_ * y - dy_ * x, along, p.z - from_.z - along * dz_};
  }

  /// Of the ground above the line over the part of [low, high] between the ends.
  double highest(double low, double low_rise, double high, double high_rise) const {
    const double slope = high > low ? (high_rise - low_rise) / (high - low) : 0;
    const auto rise = [&](double s) {
      // From the nearer end, so that a steep piece's rise is exact at both.
      const double straight = s - low < high - s ? low_rise + slope * (s - low) : high_rise - slope * (high - s);
      return straight + bulge_ * s * (1 - s);
    };
    const double first = std::max(low, 0.0), last = std::min(high, 1.0);
    double result = std::max(rise(first), rise(last));
    if (bulge_ > 0) result = std::max(result, rise(std::clamp(0.5 + slope / (2 * bulge_), first, last)));
    return result;
  }

  Point3 from_;
  double dx_, dy_, dz_;
  double per_squared_length_;
  double bulge_;
  double grazing_;
};

}  // namespace itin::viewshed
