// Sight lines of a sweep about an upright axis, while what hides them is being looked for triangle by triangle.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include <itin/geometry.hpp>

#include "line/sight_line.hpp"

namespace itin::viewshed {

inline constexpr std::uint32_t kNoSilhouette = 0xffffffff;

/// The corners of a triangle, counterclockwise.
using Corners = std::array<GridPoint, 3>;

/// How far from the axis the other end is, in bins, and the drop there, grid units.
struct SweptEnd {
  double along = 0;
  double drop = 0;
};

// Each class gives the line that is to be cleared by its height at the axis and its slope, outward per bin.

/// The end of a line, raised by every triangle that hides what is lower.
class RaisedEnd {
 public:
  double least() const { return least_; }
  std::uint32_t silhouette() const { return silhouette_; }

  bool hides(const Corners& triangle, double end) const {
    const auto& [a, b, c] = triangle;
    return line_.with_end(end).hidden_by(a, b, c);
  }

 protected:
  RaisedEnd(const SightLine& line, double least, double highest, double margin)
      : line_(line), highest_(highest), margin_(margin), least_(least) {}
  const SightLine& line() const { return line_; }

  /// Tells whether the highest end can still be seen over this triangle, too. Calls raised() if the least end becomes
  /// higher.
  template <class Raised>
  bool clears(std::uint32_t triangle, const Corners& corners, const Raised& raised) {
    const auto& [a, b, c] = corners;
    if (line_.apart(a, b, c, least_, margin_)) return true;
    const double end = line_.clearing_end(a, b, c);
    if (end <= least_) return true;
    silhouette_ = triangle;
    if (end > highest_ && hides(corners, highest_)) return false;
    // A triangle that rises by less than a grazing is only touched, though clearing it takes a hair more than the
    // highest.
    least_ = std::min(end, highest_);
    raised();
    return true;
  }

 private:
  const SightLine& line_;
  double highest_, margin_, least_;
  std::uint32_t silhouette_ = kNoSilhouette;
};

/// A line from an eye to the top of an axis: how far down the axis is seen.
class AxisSight : public RaisedEnd {
 public:
  AxisSight(const SightLine& from_eye, double base, const SweptEnd& eye, double margin)
      : RaisedEnd(from_eye, std::min(base, from_eye.to_z()), from_eye.to_z(), margin), eye_(eye) {
    update_slope();
  }

  double at_axis() const { return least(); }
  double slope() const { return slope_; }
  bool clears(std::uint32_t triangle, const Corners& corners) {
    return RaisedEnd::clears(triangle, corners, [this] { update_slope(); });
  }

 private:
  void update_slope() { slope_ = (line().from().z - eye_.drop - least()) / eye_.along; }

  SweptEnd eye_;
  double slope_ = 0;
};

/// A line from a point to a target: whether the target is seen.
class PointSight {
 public:
  PointSight(const SightLine& to_target, const SweptEnd& target)
      : line_(to_target), slope_((to_target.to_z() - target.drop - to_target.from().z) / target.along) {}

  double at_axis() const { return line_.from().z; }
  double slope() const { return slope_; }
  double least() const { return at_axis(); }
  std::uint32_t silhouette() const { return silhouette_; }

  bool clears(std::uint32_t triangle, const Corners& corners) {
    const auto& [a, b, c] = corners;
    if (!line_.hidden_by(a, b, c)) return true;
    silhouette_ = triangle;
    return false;
  }

 private:
  const SightLine& line_;
  double slope_;
  std::uint32_t silhouette_ = kNoSilhouette;
};

/// A line from a point to what may stand on the ground: how low that is seen.
class HeightSight : public RaisedEnd {
 public:
  struct Range {
    double lowest = 0, highest = 0;
    double hidden_below = 0;  ///< ends below are known to be hidden
  };
  HeightSight(const SightLine& to_lowest, const Range& range, const SweptEnd& end, double margin)
      : RaisedEnd(to_lowest, std::max(range.lowest, std::min(range.hidden_below, range.highest)), range.highest,
                  margin),
        end_(end) {
    update_slope();
  }

  double at_axis() const { return line().from().z; }
  double slope() const { return slope_; }
  bool clears(std::uint32_t triangle, const Corners& corners) {
    return RaisedEnd::clears(triangle, corners, [this] { update_slope(); });
  }

 private:
  void update_slope() { slope_ = (least() - end_.drop - at_axis()) / end_.along; }

  SweptEnd end_;
  double slope_ = 0;
};

}  // namespace itin::viewshed
