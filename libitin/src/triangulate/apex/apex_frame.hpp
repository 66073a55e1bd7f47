// The coordinate frame of one edge in the search for the third vertex of the triangle to its left (apex.hpp).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include <itin/geometry.hpp>

#include "geometry/predicates.hpp"

namespace itin {

/// The coordinate frame of one edge, in double precision.
struct ApexFrame {
  Position a, b;
  double mx, my;  ///< midpoint
  double nx, ny;  ///< unit normal to the left
  double r;       ///< half the length

  ApexFrame(Position from, Position to) : a(from), b(to) {
    const double dx = static_cast<double>(b.x) - a.x, dy = static_cast<double>(b.y) - a.y;
    const double length = std::hypot(dx, dy);
    mx = a.x + dx / 2, my = a.y + dy / 2;
    nx = -dy / length, ny = dx / length;
    r = length / 2;
  }

  double height(double x, double y) const { return (x - mx) * nx + (y - my) * ny; }

  /// Returns lambda of c (apex.hpp). (c - a) . (c - b) = |c - m|^2 - r^2 and twice the area of abc are exact, so that
  /// no digits cancel.
  double lambda(Position c) const {
    const double dot = static_cast<double>((std::int64_t{c.x} - a.x) * (std::int64_t{c.x} - b.x) +
                                           (std::int64_t{c.y} - a.y) * (std::int64_t{c.y} - b.y));
    return dot * r / static_cast<double>(doubled_area(a, b, c));
  }

  /// Tells whether a point may be inside or on the circle of lambda. Never false for such a point; it may be true for
  /// one just outside. A distant centre loses no digits, as |p - centre|^2 - radius^2 is taken relative to m.
  bool inside(double lambda, double x, double y) const {
    const double dx = x - mx, dy = y - my, square = dx * dx + dy * dy;
    const double error = 1e-12 * (square + r * r + std::abs(lambda) * (std::abs(dx) + std::abs(dy))) + 1;
    return square - r * r - 2 * lambda * (dx * nx + dy * ny) <= error;
  }

  /// Tells whether a point of the box may be inside or on the circle and left of ab. Never false where one is; it may
  /// be true elsewhere.
  bool cap_meets(double lambda, const GridBox& box) const {
    const double cx = mx + lambda * nx, cy = my + lambda * ny;
    // One unit of slack absorbs the rounding of centre and corners.
    const double x = std::clamp(cx, box.xmin - 1.0, box.xmax + 1.0), y = std::clamp(cy, box.ymin - 1.0, box.ymax + 1.0);
    return inside(lambda, x, y) && left_of(box);
  }

  bool left_of(const GridBox& box) const {
    const double x = nx > 0 ? box.xmax : box.xmin, y = ny > 0 ? box.ymax : box.ymin;
    return height(x, y) > -1;
  }

  /// Returns about the least lambda of the box: an order of visits, not a bound.
  double key(const GridBox& box) const {
    const Position nearest{static_cast<std::int32_t>(std::clamp(mx, double{1} * box.xmin, double{1} * box.xmax)),
                           static_cast<std::int32_t>(std::clamp(my, double{1} * box.ymin, double{1} * box.ymax))};
    double least = std::numeric_limits<double>::infinity();
    for (const Position p : {nearest, Position{box.xmin, box.ymin}, Position{box.xmax, box.ymin},
                             Position{box.xmin, box.ymax}, Position{box.xmax, box.ymax}}) {
      if (orientation(a, b, p) > 0) least = std::min(least, lambda(p));
    }
    return least;
  }

  /// Returns the box of the circle's part left of ab, a little enlarged and cut off at `limit`.
  GridBox cap_box(double lambda, const GridBox& limit) const {
    const double cx = mx + lambda * nx, cy = my + lambda * ny, radius = std::hypot(r, lambda);
    double xmin = std::min(a.x, b.x), xmax = std::max(a.x, b.x);
    double ymin = std::min(a.y, b.y), ymax = std::max(a.y, b.y);
    if (height(cx - radius, cy) >= 0) xmin = std::min(xmin, cx - radius);
    if (height(cx + radius, cy) >= 0) xmax = std::max(xmax, cx + radius);
    if (height(cx, cy - radius) >= 0) ymin = std::min(ymin, cy - radius);
    if (height(cx, cy + radius) >= 0) ymax = std::max(ymax, cy + radius);
    const double slack = 2 + 1e-9 * radius;
    const auto cut = [](double v, std::int32_t low, std::int32_t high) {
      return static_cast<std::int32_t>(std::clamp(v, static_cast<double>(low), static_cast<double>(high)));
    };
    return {cut(std::floor(xmin - slack), limit.xmin, limit.xmax),
            cut(std::floor(ymin - slack), limit.ymin, limit.ymax), cut(std::ceil(xmax + slack), limit.xmin, limit.xmax),
            cut(std::ceil(ymax + slack), limit.ymin, limit.ymax)};
  }
};

}  // namespace itin
