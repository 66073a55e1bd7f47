// A straight line across the plane, for which every decision is exact: the geometry that cross-sections and lines of
// sight share, so that they agree to the last bit.
//
//   const SectionLine line(grid, a, b);
//   if (line.side(p) * line.side(q) < 0) use(line.crossing(p, q));
//
// The ends are rounded to 2^-20 grid units and kept in 64-bit integers within 2^51 of the origin; grid points lie
// within 2^49, so that sides, below 2^105, are exact in 128 bits. Whichever end is given first, the line runs from the
// lesser to the greater in (x, y), so that all arithmetic is the same from either end.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <utility>

#include <itin/geometry.hpp>
#include <itin/int128.hpp>

namespace itin {

/// The step of distances, metres: as they are multiples of it, what is left of the line from there on is exact, too.
inline constexpr double kDistanceUnit = 1.0 / (1 << 30);

/// A place where the line, prolonged beyond both ends, meets the surface.
struct SectionCrossing {
  enum class Place { kBefore, kWithin, kBeyond };  ///< along the line; both ends count as within

  double t = 0;         ///< 0 at the start, 1 at the end, and exact at both
  double distance = 0;  ///< metres from the start, a multiple of kDistanceUnit
  Point3 position;
  Place place = Place::kWithin;
};

/// A piece of the surface along the line; both ends may coincide.
struct SectionPiece {
  SectionCrossing from;
  SectionCrossing to;
};

class SectionLine {
 public:
  /// Throws InputError for ends that are not finite or more than 2^31 grid units from the origin.
  SectionLine(const Grid& grid, Point2 a, Point2 b);

  const Grid& grid() const { return grid_; }
  /// Returns the length in metres, a multiple of kDistanceUnit.
  double length() const { return length_; }
  /// Tells whether both ends coincide. The line still has a direction then, due east.
  bool is_point() const { return is_point_; }
  /// Tells whether both ends are one place (same_place.hpp), though perhaps not one point.
  bool is_one_place() const;
  /// Tells whether the ends were given in the other order.
  bool is_mirrored() const { return mirrored_; }
  Point2 start() const { return start_point_; }
  Point2 end() const { return end_point_; }
  /// Returns the smallest grid box about the start.
  GridBox start_box() const;
  /// Returns the smallest grid box about the part of the line from t0 to t1, a little enlarged.
  GridBox box(double t0, double t1) const;

  /// Returns a positive number for a place to the left of the line, 0 for a place on it.
  template <class P>
  Int128 side(const P& p) const {
    return cross(dx_, dy_, subgrid(p.x) - ax_, subgrid(p.y) - ay_);
  }

  /// Returns where the line meets the closed edge pq. Its ends are on different sides, or one of them on the line.
  SectionCrossing crossing(const GridPoint& p, const GridPoint& q) const;
  /// Does the same in less time where side(p) and side(q) are known.
  SectionCrossing crossing(const GridPoint& p, Int128 side_p, const GridPoint& q, Int128 side_q) const;
  /// Returns the crossing at a vertex on the line.
  SectionCrossing crossing(const GridPoint& p) const;

  /// Returns where the line, prolonged, enters and leaves a closed triangle; nothing where it misses the triangle.
  std::optional<SectionPiece> chord(const std::array<GridPoint, 3>& corners) const;
  /// Returns the part of the line between two crossings, over which the surface is straight, that lies between the
  /// line's ends.
  std::optional<SectionPiece> clip(const SectionCrossing& from, const SectionCrossing& to) const;

  /// Tells which of two edges is crossed first: true for the first one. Both cross the line and not each other, and are
  /// given as their ends left and right of it. Ends on the line may count as either.
  template <class P>
  static bool crossed_before(const P& left1, const P& right1, const P& left2, const P& right2) {
    // The side ahead of an edge is to the left of left -> right.
    const int l1 = ahead(left2, right2, left1), r1 = ahead(left2, right2, right1);
    if (l1 <= 0 && r1 <= 0) return l1 < 0 || r1 < 0;
    if (l1 >= 0 && r1 >= 0) return false;
    return ahead(left1, right1, left2) >= 0 && ahead(left1, right1, right2) >= 0;
  }

 private:
  static constexpr std::int64_t kSubgrid = std::int64_t{1} << 20;

  static std::int64_t subgrid(std::int32_t v) { return v * kSubgrid; }
  static Int128 cross(std::int64_t ax, std::int64_t ay, std::int64_t bx, std::int64_t by) {
    return static_cast<Int128>(ax) * by - static_cast<Int128>(ay) * bx;
  }
  template <class P>
  static int ahead(const P& left, const P& right, const P& p) {
    const std::int64_t area = (std::int64_t{right.x} - left.x) * (std::int64_t{p.y} - left.y) -
                              (std::int64_t{right.y} - left.y) * (std::int64_t{p.x} - left.x);
    return (area > 0) - (area < 0);
  }
  SectionCrossing at(double t, Point3 position, SectionCrossing::Place place) const;
  SectionCrossing between(const SectionCrossing& from, const SectionCrossing& to, double t, Point2 p) const;

  Grid grid_;
  Point2 start_point_, end_point_;
  std::int64_t ax_ = 0, ay_ = 0;  ///< the start, in units of 2^-20 of the grid's
  std::int64_t dx_ = 0, dy_ = 0;  ///< the end - start
  double length_ = 0;
  bool is_point_ = false;
  bool mirrored_ = false;
};

}  // namespace itin
