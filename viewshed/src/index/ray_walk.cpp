#include "index/ray_walk.hpp"

#include <algorithm>
#include <cstdint>
#include <cstring>

#include "index/ray_stretch.hpp"
#include "line/infinity.hpp"

namespace itin::viewshed {

namespace {

/// Slopes are computed to far less than this, which is a fortieth of a millimetre at 25 km.
constexpr double kSlopeRounding = 1e-9;

/// The states of all observers of a walk, while single ones of them are looked after.
struct RayStates {
  alignas(64) OfObservers<double> top, looks, on_ground, seen, beyond;
  alignas(64) OfObservers<double> from, to;           ///< heights of the ground at the edges
  alignas(64) OfObservers<std::int64_t> behind, odd;  ///< all bits, or none

  /// No slope is greater than the first top of places where nobody stands.
  explicit RayStates(const RayWalk& walk) {
    std::transform(walk.there.begin(), walk.there.end(), top.begin(),
                   [](bool there) { return there ? -kInfinity : kInfinity; });
  }
};

/// Lets the observers pass a stretch that are odd, of `count` from number `first` on.
[[gnu::noinline]] void pass_singly(const RayStretch& stretch, const RayWalk& walk, std::size_t first, std::size_t count,
                                   RayStates& states) {
  for (std::size_t i = 0; i < count; ++i) {
    if (states.odd[i] == 0) continue;
    RayState state{states.top[i],       states.behind[i] != 0, states.looks[i],
                   states.on_ground[i], states.seen[i],        states.beyond[i]};
    stretch.pass(walk.place + static_cast<std::ptrdiff_t>(first + i), walk.eye[first + i], states.from[i], states.to[i],
                 state);
    states.top[i] = state.top, states.behind[i] = state.behind ? -1 : 0;
    states.looks[i] = state.looks, states.on_ground[i] = state.on_ground;
    states.seen[i] = state.seen, states.beyond[i] = state.beyond;
  }
}

// What follows is compiled once for each set of instructions.

namespace baseline {
#define ITIN_INSTRUCTIONS
constexpr std::size_t kInVector = 2;
#include "index/ray_walk_lanes.inc"
#undef ITIN_INSTRUCTIONS
}  // namespace baseline

#ifdef __x86_64__
namespace avx2 {
#define ITIN_INSTRUCTIONS ITIN_AVX2
constexpr std::size_t kInVector = 4;
#include "index/ray_walk_lanes.inc"
#undef ITIN_INSTRUCTIONS
}  // namespace avx2

namespace avx512 {
#define ITIN_INSTRUCTIONS ITIN_AVX512
constexpr std::size_t kInVector = 8;
#include "index/ray_walk_lanes.inc"
#undef ITIN_INSTRUCTIONS
}  // namespace avx512
#endif

}  // namespace

void walk_ray(const RayCourse& course, const PostRows& posts, Instructions instructions, RayWalk& walk) {
  switch (instructions) {
#ifdef __x86_64__
    case Instructions::kAvx512:
      return avx512::walk_all(course, posts, walk);
    case Instructions::kAvx2:
      return avx2::walk_all(course, posts, walk);
#endif
    default:
      return baseline::walk_all(course, posts, walk);
  }
}

}  // namespace itin::viewshed
