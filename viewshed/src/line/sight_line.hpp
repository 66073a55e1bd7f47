// The exact side of a viewshed: whether one triangle rises above one sight line, in double precision.
//
// Coordinates are grid units (whole numbers at vertices). Along a line from `from` to `to`, at the fraction s of its
// length d, the Earth's curvature raises the ground against the straight line by a Bulge over the length 1.
// A triangle's section by the line's vertical plane is a straight piece, so the highest point of the ground over it is
// at one of its ends or at the vertex of a parabola.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include <itin/clearance.hpp>
#include <itin/geometry.hpp>
#include <itin/grazing.hpp>
#include <itin/precondition.hpp>

#include "line/infinity.hpp"

namespace itin::viewshed {

class SightLine {
 public:
  /// The ends are in grid units; `drop` is the drop's coefficient per grid unit, `grazing` is kGrazing in grid units.
  SightLine(const Point3& from, const Point3& to, double drop, double grazing)
      : from_(from), dx_(to.x - from.x), dy_(to.y - from.y), dz_(to.z - from.z), grazing_(grazing) {
    const double squared = dx_ * dx_ + dy_ * dy_;
    per_squared_length_ = 1 / squared;
    bulge_ = {1, drop * squared};
  }

  /// The line to another height at the same place.
  SightLine with_end(double z) const {
    SightLine line = *this;
    line.dz_ = z - from_.z;
    return line;
  }

  /// Whether the triangle hides the one end from the other. Precondition: the ends differ horizontally.
  bool hidden_by(const GridPoint& a, const GridPoint& b, const GridPoint& c) const {
    ITIN_PRECONDITION(dx_ != 0 || dy_ != 0);
    const Section under = section(a, b, c);
    return under.meets_line() && highest(under) > grazing_;
  }

  /// Returns where the triangle first hides, as a fraction of the length; nothing where it does not hide.
  std::optional<double> hidden_from(const GridPoint& a, const GridPoint& b, const GridPoint& c) const {
    const Section under = section(a, b, c);
    if (!under.meets_line() || highest(under) <= grazing_) return std::nullopt;
    const double first = std::max(under.low, 0.0), last = std::min(under.high, 1.0);
    if (rise(under, first) > grazing_) return first;
    // The least root of p + q s + drop s (1 - s) = grazing, which lies where the left side grows.
    const double drop = bulge_.drop, q = under.slope() + drop, missing = grazing_ - under.straight(0);
    if (q <= 0) return last;
    const double root = std::sqrt(std::max(0.0, q * q - 4 * drop * missing));
    return std::clamp(2 * missing / (q + root), first, last);
  }

  /// Calls visit(i, j, weight, fraction of the length, rise of the curved ground above the line) for every edge of a
  /// triangle that the line crosses between the ends. The edge goes from corner i to j > i, where j has that weight.
  /// Also visits every corner that the line passes over, with j = i.
  template <class Visit>
  void for_each_crossing(const std::array<GridPoint, 3>& triangle, const Visit& visit) const {
    const std::array<Corner, 3> corners{corner(triangle[0]), corner(triangle[1]), corner(triangle[2])};
    const auto at = [&](std::size_t i, std::size_t j, double weight) {
      const double s = corners[i].along + weight * (corners[j].along - corners[i].along);
      const double rise = corners[i].rise + weight * (corners[j].rise - corners[i].rise);
      if (s >= 0 && s <= 1) visit(i, j, weight, s, rise + bulge_.at(s));
    };
    for (std::size_t i = 0; i < 3; ++i) {
      const double side = corners[i].side;
      if (side == 0) at(i, i, 0);
      for (std::size_t j = i + 1; j < 3; ++j) {
        const double other = corners[j].side;
        if ((side < 0 && other > 0) || (side > 0 && other < 0)) at(i, j, side / (side - other));
      }
    }
  }

  /// Whether the triangle lies wholly to one side of the line.
  bool beside(const GridPoint& a, const GridPoint& b, const GridPoint& c) const {
    const auto side = [&](const GridPoint& p) { return dx_ * (p.y - from_.y) - dy_ * (p.x - from_.x); };
    const double sa = side(a), sb = side(b), sc = side(c);
    return (sa > 0 && sb > 0 && sc > 0) || (sa < 0 && sb < 0 && sc < 0);
  }

  /// The ground over a triangle, as far as it lies between the ends: a straight piece from one fraction of the length
  /// to another, with its heights above the straight line (without the Earth's bulge).
  struct Ground {
    double from = 0, to = 0;
    double from_rise = 0, to_rise = 0;
  };
  /// Returns nothing where the line does not pass over the triangle.
  std::optional<Ground> ground_over(const GridPoint& a, const GridPoint& b, const GridPoint& c) const {
    const Section under = section(a, b, c);
    if (!under.meets_line()) return std::nullopt;
    const double first = std::max(under.low, 0.0), last = std::min(under.high, 1.0);
    return Ground{first, last, under.straight(first), under.straight(last)};
  }

  /// Returns where between the ends the triangle rises highest above the line, as a fraction of the length.
  /// Precondition: the line passes over the triangle.
  double highest_at(const GridPoint& a, const GridPoint& b, const GridPoint& c) const {
    const Section under = section(a, b, c);
    ITIN_PRECONDITION(under.meets_line());
    const double first = std::max(under.low, 0.0), last = std::min(under.high, 1.0);
    double best = first;
    const auto consider = [&](double s) {
      if (rise(under, s) > rise(under, best)) best = s;
    };
    if (bulge_.drop > 0) consider(std::clamp(bulge_.summit(under.slope()), first, last));
    consider(last);
    return best;
  }

  /// The least height of the end `to`, its position kept, at which the triangle does not hide it: -infinity where the
  /// line does not pass over the triangle, +infinity where the end `from` lies beneath it. At that height the triangle
  /// touches the line, to half a grazing, so that rounding cannot make it hide again.
  double clearing_end(const GridPoint& a, const GridPoint& b, const GridPoint& c) const {
    if (beside(a, b, c)) return -kInfinity;
    const Section under = section(a, b, c);
    if (!under.meets_line()) return -kInfinity;
    const double first = std::max(under.low, 0.0), last = std::min(under.high, 1.0);
    // The ground's rise is p + q s + drop s (1 - s); the end must rise by the greatest (rise - slack) / s.
    const double q = under.slope(), p = under.straight(0);
    double slack = grazing_ / 2;
    if (first == 0) {
      if (p > grazing_) return kInfinity;
      slack = std::max(slack, p);
    }
    const auto needed = [&](double s) {
      if (s > 0) return (rise(under, s) - slack) / s;
      return p < slack ? -kInfinity : q + bulge_.drop;
    };
    double result = std::max(needed(first), needed(last));
    if (bulge_.drop > 0 && p < slack)
      result = std::max(result, needed(std::clamp(std::sqrt((slack - p) / bulge_.drop), first, last)));
    return to_z() + result;
  }

  /// Tells whether the triangle lies to one side of the line, or is below the line to `end` by at least `margin`
  /// wherever the two meet. If so, it hides nothing there. Cheaper than clearing_end(), and never contradicts it.
  bool apart(const GridPoint& a, const GridPoint& b, const GridPoint& c, double end, double margin) const {
    const double dz = end - from_.z;
    const auto corner_at = [&](const GridPoint& p) {
      const double x = p.x - from_.x, y = p.y - from_.y;
      const double along = (x * dx_ + y * dy_) * per_squared_length_;
      return Corner{dx_ * y - dy_ * x, along, p.z - from_.z - along * dz + bulge_.at(along)};
    };
    const Corner p = corner_at(a), q = corner_at(b), r = corner_at(c);
    if ((p.side > 0 && q.side > 0 && r.side > 0) || (p.side < 0 && q.side < 0 && r.side < 0)) return true;
    // Between corners curvature raises the ground above the straight piece.
    const double stretch = std::max({p.along, q.along, r.along}) - std::min({p.along, q.along, r.along});
    const double limit = -margin - std::max(bulge_.drop, 0.0) * stretch * stretch / 4;
    if (std::max({p.rise, q.rise, r.rise}) <= limit) return true;
    const auto below = [&](const Corner& from, const Corner& to) {
      const double across = from.side - to.side;
      if (from.side * to.side >= 0) return from.side * to.side > 0 || std::max(from.rise, to.rise) <= limit;
      return from.rise + from.side / across * (to.rise - from.rise) <= limit;
    };
    return below(p, q) && below(q, r) && below(r, p);
  }

  const Point3& from() const { return from_; }
  double dx() const { return dx_; }
  double dy() const { return dy_; }
  /// The Earth's bulge, by fractions of the length.
  const Bulge& bulge() const { return bulge_; }
  double to_z() const { return from_.z + dz_; }

 private:
  struct Corner {
    double side;   ///< to which side of the line, times its length
    double along;  ///< fraction of the line's length
    double rise;   ///< above the straight line
  };

  /// A triangle's cut by the line's vertical plane: from `low` to `high` along the line.
  struct Section {
    double low = 2, high = -1;
    double low_rise = 0, high_rise = 0;  ///< above the straight line

    void add(double along, double rise) {
      if (along < low) low = along, low_rise = rise;
      if (along > high) high = along, high_rise = rise;
    }
    bool meets_line() const { return low <= 1 && high >= 0 && low <= high; }
    double slope() const { return high > low ? (high_rise - low_rise) / (high - low) : 0; }
    /// The rise at `s`, measured from the nearer end, so that a steep piece's rise is exact at both.
    double straight(double s) const {
      return s - low < high - s ? low_rise + slope() * (s - low) : high_rise - slope() * (high - s);
    }
  };

  Section section(const GridPoint& a, const GridPoint& b, const GridPoint& c) const {
    const std::array<Corner, 3> corners{corner(a), corner(b), corner(c)};
    Section result;
    // Triangles are closed: an edge or a corner that only touches the line belongs to the section.
    for (std::size_t i = 0; i < 3; ++i) {
      const Corner &p = corners[i], &q = corners[i == 2 ? 0 : i + 1];
      if (p.side == 0) result.add(p.along, p.rise);
      if ((p.side < 0) == (q.side < 0) || p.side == 0 || q.side == 0) continue;
      const double w = p.side / (p.side - q.side);
      result.add(p.along + w * (q.along - p.along), p.rise + w * (q.rise - p.rise));
    }
    return result;
  }

  Corner corner(const GridPoint& p) const {
    const double x = p.x - from_.x, y = p.y - from_.y;
    const double along = (x * dx_ + y * dy_) * per_squared_length_;
    return {dx_ * y - dy_ * x, along, p.z - from_.z - along * dz_};
  }

  /// The height of the curved ground above the straight line.
  double rise(const Section& under, double s) const { return under.straight(s) + bulge_.at(s); }

  /// The greatest height of the ground above the line over the part of [low, high] between the ends.
  double highest(const Section& under) const {
    const double first = std::max(under.low, 0.0), last = std::min(under.high, 1.0);
    double result = std::max(rise(under, first), rise(under, last));
    if (bulge_.drop > 0) result = std::max(result, rise(under, std::clamp(bulge_.summit(under.slope()), first, last)));
    return result;
  }

  Point3 from_;
  double dx_, dy_, dz_;
  double per_squared_length_;
  Bulge bulge_;
  double grazing_;
};

}  // namespace itin::viewshed
