// Points, boxes and the integer grid that every stored coordinate lies on.
//
//   itin::Grid grid{{0.0, 0.0}, 0.01};                     // 1 cm
//   itin::GridPoint p = grid.quantise({318000.25, 176000.5, 83.1});
//   itin::Point3 q = grid.point(p);                        // exactly representable, so q quantises to p again
//
// Units: metres, easting / northing / up, in the store's projected coordinate reference system. Grid coordinates are
// whole multiples of the resolution relative to the grid's origin; they stay within [-2^29, 2^29), so that differences
// fit in 31 bits and the predicates built on them in 128.
#pragma once

#include <algorithm>
#include <cmath>
#include <compare>
#include <cstdint>
#include <limits>

namespace itin {

struct Point2 {
  double x = 0;
  double y = 0;
  friend bool operator==(const Point2&, const Point2&) = default;
};

struct Point3 {
  double x = 0;
  double y = 0;
  double z = 0;
  friend bool operator==(const Point3&, const Point3&) = default;
};

/// The distance between two positions, metres.
inline double distance(Point2 p, Point2 q) {
  return std::hypot(q.x - p.x, q.y - p.y);
}

/// A closed axis-parallel box in metres. It is empty when a minimum exceeds its maximum, as in a default box.
struct Box {
  double xmin = std::numeric_limits<double>::infinity();
  double ymin = std::numeric_limits<double>::infinity();
  double xmax = -std::numeric_limits<double>::infinity();
  double ymax = -std::numeric_limits<double>::infinity();

  bool empty() const { return xmin > xmax || ymin > ymax; }
  double width() const { return empty() ? 0 : xmax - xmin; }
  double height() const { return empty() ? 0 : ymax - ymin; }
  bool contains(Point2 p) const { return p.x >= xmin && p.x <= xmax && p.y >= ymin && p.y <= ymax; }
  bool meets(const Box& b) const { return xmin <= b.xmax && b.xmin <= xmax && ymin <= b.ymax && b.ymin <= ymax; }
  void extend(Point2 p) {
    xmin = std::min(xmin, p.x), xmax = std::max(xmax, p.x);
    ymin = std::min(ymin, p.y), ymax = std::max(ymax, p.y);
  }
  void extend(const Box& b) {
    if (b.empty()) return;
    extend(Point2{b.xmin, b.ymin});
    extend(Point2{b.xmax, b.ymax});
  }
  friend bool operator==(const Box&, const Box&) = default;
};

/// A position on the grid. Positions are ordered lexicographically by (x, y, z); no two vertices of a store share
/// (x, y).
struct GridPoint {
  std::int32_t x = 0;
  std::int32_t y = 0;
  std::int32_t z = 0;
  friend auto operator<=>(const GridPoint&, const GridPoint&) = default;
};

/// A closed axis-parallel box of grid positions.
struct GridBox {
  std::int32_t xmin = std::numeric_limits<std::int32_t>::max();
  std::int32_t ymin = std::numeric_limits<std::int32_t>::max();
  std::int32_t xmax = std::numeric_limits<std::int32_t>::min();
  std::int32_t ymax = std::numeric_limits<std::int32_t>::min();

  bool empty() const { return xmin > xmax || ymin > ymax; }
  bool contains(std::int32_t x, std::int32_t y) const { return x >= xmin && x <= xmax && y >= ymin && y <= ymax; }
  bool contains(const GridBox& b) const {
    return b.empty() || (b.xmin >= xmin && b.xmax <= xmax && b.ymin >= ymin && b.ymax <= ymax);
  }
  bool meets(const GridBox& b) const { return xmin <= b.xmax && b.xmin <= xmax && ymin <= b.ymax && b.ymin <= ymax; }
  void extend(std::int32_t x, std::int32_t y) {
    xmin = std::min(xmin, x), xmax = std::max(xmax, x);
    ymin = std::min(ymin, y), ymax = std::max(ymax, y);
  }
  void extend(const GridBox& b) {
    if (b.empty()) return;
    extend(b.xmin, b.ymin);
    extend(b.xmax, b.ymax);
  }
  friend bool operator==(const GridBox&, const GridBox&) = default;
};

/// Grid coordinates lie in [-kGridHalfSide, kGridHalfSide).
inline constexpr std::int32_t kGridHalfSide = std::int32_t{1} << 29;

inline Box intersection(const Box& a, const Box& b) {
  return {std::max(a.xmin, b.xmin), std::max(a.ymin, b.ymin), std::min(a.xmax, b.xmax), std::min(a.ymax, b.ymax)};
}

/// The square that holds the disc of this radius.
inline Box square_about(Point2 centre, double radius) {
  return {centre.x - radius, centre.y - radius, centre.x + radius, centre.y + radius};
}

inline GridBox intersection(const GridBox& a, const GridBox& b) {
  return {std::max(a.xmin, b.xmin), std::max(a.ymin, b.ymin), std::min(a.xmax, b.xmax), std::min(a.ymax, b.ymax)};
}

/// Returns the smallest grid box that contains b, a box in grid units, cut off at the grid's limits.
inline GridBox rounded_outwards(const Box& b) {
  if (b.empty()) return {};
  const auto cut = [](double v) {
    return static_cast<std::int32_t>(std::clamp(v, -static_cast<double>(kGridHalfSide), kGridHalfSide - 1.0));
  };
  return {cut(std::floor(b.xmin)), cut(std::floor(b.ymin)), cut(std::ceil(b.xmax)), cut(std::ceil(b.ymax))};
}

/// The box widened by this margin, in grid units, on all sides.
inline GridBox expanded(const GridBox& b, double margin) {
  return rounded_outwards({b.xmin - margin, b.ymin - margin, b.xmax + margin, b.ymax + margin});
}

/// The affine map between metres and grid coordinates. Heights have the same resolution and origin 0.
struct Grid {
  Point2 origin;
  double resolution = 0.01;  ///< metres, > 0

  Point3 point(GridPoint p) const {
    return {origin.x + p.x * resolution, origin.y + p.y * resolution, p.z * resolution};
  }
  Point2 position(std::int32_t x, std::int32_t y) const {
    return {origin.x + x * resolution, origin.y + y * resolution};
  }
  /// Returns the nearest grid position (halves away from zero). Precondition: covers({p.x, p.y}), |z| < 2^31 units.
  GridPoint quantise(Point3 p) const {
    return {static_cast<std::int32_t>(std::llround((p.x - origin.x) / resolution)),
            static_cast<std::int32_t>(std::llround((p.y - origin.y) / resolution)),
            static_cast<std::int32_t>(std::llround(p.z / resolution))};
  }
  /// Tells whether the grid can represent a position.
  bool covers(Point2 p) const {
    const double limit = kGridHalfSide - 1.0;
    return std::abs(p.x - origin.x) <= limit * resolution && std::abs(p.y - origin.y) <= limit * resolution;
  }
  Box box(const GridBox& b) const {
    if (b.empty()) return {};
    const Point2 low = position(b.xmin, b.ymin), high = position(b.xmax, b.ymax);
    return {low.x, low.y, high.x, high.y};
  }
  /// The smallest grid box that contains b, cut off at the grid's own limits.
  GridBox enclosing(const Box& b) const {
    return rounded_outwards({(b.xmin - origin.x) / resolution, (b.ymin - origin.y) / resolution,
                             (b.xmax - origin.x) / resolution, (b.ymax - origin.y) / resolution});
  }
  friend bool operator==(const Grid&, const Grid&) = default;
};

}  // namespace itin
