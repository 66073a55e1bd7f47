// A lattice of posts, and the widest one that some points lie on.
//
//   WidestLattice widest;
//   for (const GridPoint& p : points) widest.add(p.x, p.y);
//   widest.lattice().step_x
#pragma once

#include <compare>
#include <cstdint>
#include <numeric>
#include <optional>

#include "geometry/common_divisor.hpp"
#include "geometry/whole_division.hpp"

namespace itin {

/// A place on a lattice, by its column and row.
struct LatticePlace {
  std::int64_t column = 0, row = 0;
  friend bool operator==(const LatticePlace&, const LatticePlace&) = default;
};

/// The places (x + i step_x, y + j step_y), grid units. A step is 1 where all points have the same coordinate.
struct PostLattice {
  std::int64_t x = 0, y = 0;
  std::int64_t step_x = 1, step_y = 1;

  /// Returns the place of a position, which is anything with x and y; nothing off the lattice.
  template <class Point>
  std::optional<LatticePlace> place_of(const Point& p) const {
    const std::int64_t east = p.x - x, north = p.y - y;
    if (east % step_x != 0 || north % step_y != 0) return std::nullopt;
    return LatticePlace{east / step_x, north / step_y};
  }
  /// Returns the side of the widest squares that have all places among their corners.
  std::int64_t side() const { return std::gcd(step_x, step_y); }
  /// Returns the same places, counted from the first one whose coordinates are not negative: equal lattices are then
  /// equal in all members.
  PostLattice from_first_place() const {
    return {x - floor_divide(x, step_x) * step_x, y - floor_divide(y, step_y) * step_y, step_x, step_y};
  }
  friend auto operator<=>(const PostLattice&, const PostLattice&) = default;
};

/// Finds the lattice with the greatest steps that has all added points.
class WidestLattice {
 public:
  void add(std::int32_t x, std::int32_t y) {
    if (empty_) first_x_ = x, first_y_ = y, empty_ = false;
    step_x_.include(std::int64_t{x} - first_x_);
    step_y_.include(std::int64_t{y} - first_y_);
  }
  /// Returns the lattice; it has the first added point as its place (x, y).
  PostLattice lattice() const {
    return {first_x_, first_y_, static_cast<std::int64_t>(step_x_.value()), static_cast<std::int64_t>(step_y_.value())};
  }

 private:
  bool empty_ = true;
  std::int32_t first_x_ = 0, first_y_ = 0;
  CommonDivisor step_x_, step_y_;
};

}  // namespace itin
