// A straight line over the curved ground: the one place where clearances are computed, for single lines of sight, for
// profiles, for Fresnel zones and for viewsheds (law 4).
//
//   const LineOverGround line(120.5, 98.0, 8000, earth.drop_coefficient());
//   line.clearance({2500, ground});                               // above a place of the ground
//   if (const auto lowest = line.lowest_between(a, b)) ...        // over straight ground between two places
//
// Heights and distances share one unit: metres, grid units, or distances as fractions of a length of 1.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <itin/precondition.hpp>

namespace itin {

/// The Earth's surface against the chord between both ends of a line: the surface bulges above it, and straight ground
/// with the surface.
struct Bulge {
  double length = 1;
  double drop = 0;  ///< Earth::drop_coefficient(), or that times the squared length where the length is 1

  double at(double distance) const { return drop * (distance * (length - distance)); }
  /// Returns where straight ground is highest against the line, if it gains `slope` on the line per unit of distance:
  /// the bulge is a parabola. Precondition: drop > 0.
  double summit(double slope) const {
    ITIN_PRECONDITION(drop > 0);
    return (length + slope / drop) / 2;
  }
};

/// A place of the ground under a line.
struct GroundPoint {
  double distance = 0;  ///< from the line's start
  double z = 0;
};

/// Straight ground under a line. For distances d in [from, to] the clearance is constant + linear d + square d^2, which
/// is convex.
struct ClearancePiece {
  double from = 0, to = 0;
  double constant = 0, linear = 0, square = 0;

  double at(double d) const { return constant + d * (linear + d * square); }
  /// Returns where the clearance is least in [first, last], a part of the piece.
  double least_within(double first, double last) const {
    if (square > 0) return std::clamp(-linear / (2 * square), first, last);
    return at(first) < at(last) ? first : last;
  }
  /// Returns where the ground rises above the line; an empty stretch where it does so nowhere by more than `grazing`.
  /// There is one such stretch at most, for the clearance is convex.
  std::pair<double, double> above_line(double grazing) const {
    // A convex clearance is nowhere greater than at one of both ends.
    if (at(from) < -grazing && at(to) < -grazing) return {from, to};
    const double lowest = least_within(from, to);
    if (at(lowest) >= -grazing) return {lowest, lowest};
    // The roots of the parabola about its lowest place; those of a straight line are at infinity on one side.
    const double root = std::sqrt(std::max(0.0, linear * linear - 4 * square * constant));
    const double q = -(linear + std::copysign(root, linear)) / 2;
    double first = from, last = to;
    for (const double r : {square > 0 ? q / square : NAN, q != 0 ? constant / q : NAN}) {
      if (r > from && r <= lowest) first = std::max(first, r);
      if (r < to && r >= lowest) last = std::min(last, r);
    }
    return {first, last};
  }
};

class LineOverGround {
 public:
  LineOverGround(double start_z, double end_z, double length, double drop)
      : start_z_(start_z), end_z_(end_z), rise_((end_z - start_z) / length), bulge_{length, drop} {}

  double length() const { return bulge_.length; }

  /// Returns the line's height, computed from the nearer end, so that a level line is level and the line given from the
  /// other end has equal heights.
  double height(double distance) const {
    const double left = length() - distance;
    if (length() == 0) return start_z_;
    if (distance == left) return (start_z_ + end_z_) / 2;
    return distance < left ? start_z_ + (end_z_ - start_z_) * (distance / length())
                           : end_z_ + (start_z_ - end_z_) * (left / length());
  }

  double clearance(const GroundPoint& p) const { return height(p.distance) - p.z - bulge_.at(p.distance); }

  /// Returns the place of the straight ground from a to b with the least clearance, if it lies between them.
  std::optional<GroundPoint> lowest_between(const GroundPoint& a, const GroundPoint& b) const {
    const double width = b.distance - a.distance;
    if (width <= 0 || bulge_.drop <= 0) return std::nullopt;
    const double distance = bulge_.summit((b.z - a.z) / width - rise_);
    if (distance <= a.distance || distance >= b.distance) return std::nullopt;
    return GroundPoint{distance, a.z + (distance - a.distance) / width * (b.z - a.z)};
  }

  /// Returns the straight ground from a to b as a piece. Precondition: a is nearer to the start than b.
  ClearancePiece piece(const GroundPoint& a, const GroundPoint& b) const {
    ITIN_PRECONDITION(a.distance < b.distance);
    const double slope = (b.z - a.z) / (b.distance - a.distance);
    return {a.distance, b.distance, start_z_ - (a.z - slope * a.distance), rise_ - slope - bulge_.drop * length(),
            bulge_.drop};
  }

 private:
  double start_z_, end_z_;
  double rise_;  ///< what the line gains per unit of distance
  Bulge bulge_;
};

}  // namespace itin
