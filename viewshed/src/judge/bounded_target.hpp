// What is known of a cell's target before any line to it is cast, where its ground is known between two heights.
//
//   const BoundedTarget target = bounded_target(eye, centre, place, low_m, high_m);
//   if (target.verdict != Verdict::kUndecided) return target.verdict;
#pragma once

#include <cmath>
#include <optional>

#include <itin/geometry.hpp>
#include <itin/grazing.hpp>
#include <viewshed/result.hpp>

#include "request/eye.hpp"

namespace itin::viewshed {

struct BoundedTarget {
  Verdict verdict = Verdict::kUndecided;
  double low = 0, high = 0;                    ///< where the target may be, metres
  std::optional<bool> in_view = std::nullopt;  ///< nothing where the elevations in view may leave the target out
};

/// `centre` is the cell's centre in metres, and `place` in grid units. The ground there is at `low_ground` at least and
/// at `high_ground` at most, metres; both are NaN where there is none.
inline BoundedTarget bounded_target(const Eye& eye, Point2 centre, Point2 place, double low_ground,
                                    double high_ground) {
  if (std::isnan(low_ground)) return {.verdict = Verdict::kOutside};
  const auto [dx, dy] = eye.offset_to(centre, place);
  BoundedTarget target{.low = eye.target(low_ground), .high = eye.target(high_ground)};
  target.in_view = eye.view.contains(dx, dy, target.low - eye.elevation, target.high - eye.elevation);
  if (target.in_view == false) {
    target.verdict = Verdict::kOutside;
  } else if (target.in_view && target.high < low_ground - kGrazing) {
    target.verdict = Verdict::kHidden;  // an elevation below the ground
  } else if (target.in_view && eye.stands_at(place)) {
    target.verdict = Verdict::kVisible;
  }
  return target;
}

}  // namespace itin::viewshed
