// The height of a Tin's surface under a position, in double precision.
//
//   const std::optional<double> metres = height_on(tin, {318000.25, 176000.5});
#pragma once

#include <array>
#include <optional>
#include <span>
#include <utility>

#include <itin/precondition.hpp>
#include <itin/tin.hpp>

namespace itin {

/// A place where a row crosses an edge, in grid units.
struct RowCrossing {
  double x = 0;
  double z = 0;
};

/// A triangle with its vertices in ascending order of (y, x), so that both triangles at an edge see the edge alike and
/// its crossings with a row agree to the last bit.
class RowSections {
 public:
  explicit RowSections(const std::array<GridPoint, 3>& corners)
      : corners_{as_point(corners[0]), as_point(corners[1]), as_point(corners[2])} {
    order(0, 1), order(1, 2), order(0, 1);
  }

  double lowest() const { return corners_[0].y; }
  double highest() const { return corners_[2].y; }

  /// Returns the crossings from west to east. Precondition: lowest() <= y <= highest().
  std::pair<RowCrossing, RowCrossing> at(double y) const {
    ITIN_PRECONDITION(lowest() <= y && y <= highest());
    const auto& [a, b, c] = corners_;
    RowCrossing p = cross(a, c, y);
    RowCrossing q = y < b.y ? cross(a, b, y) : cross(b, c, y);
    if (y == b.y) q = {b.x, b.z};
    if (q.x < p.x) std::swap(p, q);
    return {p, q};
  }

  static double height(const RowCrossing& west, const RowCrossing& east, double x) {
    // A height on an edge is the one that both triangles there have, to the last bit.
    if (x == west.x || east.x == west.x) return west.z;
    if (x == east.x) return east.z;
    return west.z + (east.z - west.z) * ((x - west.x) / (east.x - west.x));
  }

 private:
  static Point3 as_point(const GridPoint& v) {
    return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
  }

  void order(std::size_t first, std::size_t second) {
    Point3 &a = corners_[first], &b = corners_[second];
    if (b.y != a.y ? b.y < a.y : b.x < a.x) std::swap(a, b);
  }

  static RowCrossing cross(const Point3& a, const Point3& b, double y) {
    if (y >= b.y) return {b.x, b.z};
    const double w = (y - a.y) / (b.y - a.y);
    return {a.x + w * (b.x - a.x), a.z + w * (b.z - a.z)};
  }

  std::array<Point3, 3> corners_;
};

/// Returns the height over a single triangle at a position, all in grid units, if the triangle holds the position.
std::optional<double> height_over(const std::array<GridPoint, 3>& triangle, Point2 units);

/// Returns the height in grid units at a position in grid units, over the first of `triangles` that holds it.
std::optional<double> height_over(const Tin& tin, std::span<const std::uint32_t> triangles, Point2 units);

/// Returns the height in metres at a position in metres, by looking at every triangle of the Tin.
std::optional<double> height_on(const Tin& tin, Point2 position);

}  // namespace itin
