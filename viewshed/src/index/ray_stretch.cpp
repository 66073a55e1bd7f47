#include "index/ray_stretch.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "line/infinity.hpp"

namespace itin::viewshed {

namespace {

/// Straight ground along a part of a stretch, which is that from share `first` to share `last` of the way.
struct StraightGround {
  double from = 0, to = 0;  ///< heights, drawn out to both ends of the stretch
  double first = 0, last = 1;

  double at(double share) const { return from + share * (to - from); }
};

/// Returns the part of the stretch that lies over a half with a rising diagonal; nothing where it misses the half.
std::optional<StraightGround> ground_over_half(const HalfPlane& plane, LatticeTin::Half half,
                                               const RayCrossing& crossing) {
  // The half lies where u + v is at most 1, or where it is at least 1.
  const double sign = half == LatticeTin::kNorthWest ? 1 : -1;
  const double before = sign * (crossing.u + crossing.v - 1), after = sign * (crossing.next_u + crossing.next_v - 1);
  if (before > 0 && after > 0) return std::nullopt;
  StraightGround ground{plane.at(crossing.u, crossing.v), plane.at(crossing.next_u, crossing.next_v)};
  if (before > 0) ground.first = before / (before - after);
  if (after > 0) ground.last = before / (before - after);
  return ground;
}

}  // namespace

void RayStretch::pass(std::ptrdiff_t place, double eye, double from, double to, RayState& state) const {
  const RayFan& fan = course.fan();
  const RayStep& s = course.steps()[step];
  std::optional<StraightGround> ground = StraightGround{from, to};
  const int there = posts.halves() != nullptr ? posts.halves()[place + s.cell] : LatticeTin::kFalling;
  if ((there & LatticeTin::kRising) != 0) {
    const auto half = (there & LatticeTin::kNorthWest) != 0 ? LatticeTin::kNorthWest : LatticeTin::kSouthEast;
    const RayCrossing& crossing = course.crossing(step);
    ground = ground_over_half(posts.plane(place, crossing.column, crossing.row, half), half, crossing);
  }
  if (!ground) {
    state.behind = true;
    return;
  }
  const double grazed = eye + fan.grazing;
  const auto distance = [&](double share) { return s.before + share * (s.distance - s.before); };
  const auto slope = [&](double share) {
    const double d = distance(share);
    return d > 0 ? (ground->at(share) - grazed - fan.drop * d * d) / d : -kInfinity;
  };
  if (ground->first > 0) state.behind = true;
  state.top = std::max(state.top, slope(ground->first));
  // The ground, drawn out to the observer, lies `depth` below the eye there: its slope is
  // gain - drop d - depth / d, which is greatest at the square root of depth / drop.
  const double gain = (ground->to - ground->from) / (s.distance - s.before);
  const double depth = (ground->to - ground->from) * s.ratio - (ground->from - grazed);
  double summit = kInfinity, summit_slope = -kInfinity;
  if (fan.drop > 0 && depth > 0) {
    const double highest = std::sqrt(depth / fan.drop);
    if (highest > distance(ground->first) && highest < distance(ground->last))
      summit = highest, summit_slope = gain - 2 * std::sqrt(fan.drop * depth);
  }
  for (const RayLook* look = looks; look != looks + s.looks; ++look) {
    if (look->share < ground->first || look->share > ground->last) continue;
    ++state.looks, state.on_ground += look->weight;
    const double before = look->distance > summit ? std::max(state.top, summit_slope) : state.top;
    const double seen_at = (ground->at(look->share) + fan.target_height - look->drop - eye) * look->per_distance;
    if (seen_at >= before) (state.behind ? state.beyond : state.seen) += look->weight;
  }
  state.top = std::max({state.top, summit_slope, slope(ground->last)});
  if (ground->last < 1) state.behind = true;
}

}  // namespace itin::viewshed
