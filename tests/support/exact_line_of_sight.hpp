// The slow, obviously right line of sight: every triangle is cut by the vertical plane through the line, in long
// double, with the Earth's curvature exact inside each triangle. Shares no code with the viewshed library.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include <itin/earth.hpp>
#include <itin/tin.hpp>

namespace itin::test {

class ExactLineOfSight {
 public:
  ExactLineOfSight(const Tin& tin, const Earth& earth) : drop_(earth.drop_coefficient()) {
    for (const Triangle& t : tin.triangles) {
      Patch patch;
      for (std::size_t i = 0; i < 3; ++i) {
        const GridPoint& v = tin.vertices[t[i]];
        const long double unit = tin.grid.resolution;
        patch.x[i] = tin.grid.origin.x + v.x * unit;
        patch.y[i] = tin.grid.origin.y + v.y * unit;
        patch.z[i] = v.z * unit;
      }
      patch.measure_edges();
      patches_.push_back(patch);
    }
  }

  /// Height of the surface, if there is any; `margin` metres beyond a triangle's edges still count as inside.
  std::optional<double> height(Point2 p, double margin = kMargin) const {
    for (const Patch& t : patches_) {
      bool inside = true;
      for (std::size_t i = 0; i < 3; ++i) inside = inside && t.depth(i, p.x, p.y) >= -margin;
      if (inside) return static_cast<double>(t.height(p.x, p.y));
    }
    return std::nullopt;
  }

  /// Least height of the straight line above the curved ground, ends included, metres; +infinity over no ground at all.
  double clearance(const Point3& from, const Point3& to) const {
    const long double dx = static_cast<long double>(to.x) - from.x, dy = static_cast<long double>(to.y) - from.y;
    const long double bulge = drop_ * (dx * dx + dy * dy);
    long double least = std::numeric_limits<long double>::infinity();
    for (const Patch& t : patches_) {
      // The part [low, high] of the line over the closed triangle.
      long double low = 0, high = 1;
      for (std::size_t i = 0; i < 3 && low <= high; ++i) {
        const long double start = t.depth(i, from.x, from.y) + kMargin, end = t.depth(i, to.x, to.y) + kMargin;
        if (start < 0 && end < 0) high = -1;
        if (start < 0 && end >= 0) low = std::max(low, start / (start - end));
        if (start >= 0 && end < 0) high = std::min(high, start / (start - end));
      }
      if (low > high) continue;
      const auto above = [&](long double s) {
        const long double line = from.z + s * (static_cast<long double>(to.z) - from.z);
        return line - t.height(from.x + s * dx, from.y + s * dy) - bulge * s * (1 - s);
      };
      least = std::min({least, above(low), above(high)});
      if (bulge > 0 && high > low) {
        // above() is a parabola bulge s^2 + b s + c; its slope follows from its ends.
        const long double slope = (above(high) - above(low)) / (high - low) - bulge * (high + low);
        least = std::min(least, above(std::clamp(-slope / (2 * bulge), low, high)));
      }
    }
    return static_cast<double>(least);
  }

 private:
  /// Metres beyond a triangle's edges that still count as inside: where the ground ends, no triangle is beside it to
  /// hold what rounding has outside.
  static constexpr double kMargin = 1e-9;

  struct Patch {
    std::array<long double, 3> x, y, z;
    std::array<long double, 3> length;  ///< edge i runs from corner i to the next

    void measure_edges() {
      for (std::size_t i = 0; i < 3; ++i) length[i] = std::hypot(x[(i + 1) % 3] - x[i], y[(i + 1) % 3] - y[i]);
    }
    /// Distance to the left of edge i.
    long double depth(std::size_t i, long double px, long double py) const {
      const std::size_t j = (i + 1) % 3;
      const long double ex = x[j] - x[i], ey = y[j] - y[i];
      return (ex * (py - y[i]) - ey * (px - x[i])) / length[i];
    }
    long double height(long double px, long double py) const {
      const long double ux = x[1] - x[0], uy = y[1] - y[0], vx = x[2] - x[0], vy = y[2] - y[0];
      const long double det = ux * vy - uy * vx;
      const long double a = ((px - x[0]) * vy - (py - y[0]) * vx) / det;
      const long double b = (ux * (py - y[0]) - uy * (px - x[0])) / det;
      return z[0] + a * (z[1] - z[0]) + b * (z[2] - z[0]);
    }
  };

  std::vector<Patch> patches_;
  long double drop_;
};

}  // namespace itin::test
