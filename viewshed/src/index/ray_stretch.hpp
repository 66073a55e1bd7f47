// What a ray meets between two edges of a lattice, decided for one observer: where the slope of the ground is greatest
// in between, or where the cell is not whole. ray_walk.hpp decides all else for many observers at once.
#pragma once

#include <cstddef>

#include "index/post_rows.hpp"
#include "index/ray_course.hpp"

namespace itin::viewshed {

/// What an observer has seen so far along a ray, and what stands in the way of the rest.
struct RayState {
  double top = 0;       ///< the greatest slope so far
  bool behind = false;  ///< ground without data was crossed
  double looks = 0, on_ground = 0, seen = 0, beyond = 0;
};

/// The stretch of a course before one of its steps' edges.
struct RayStretch {
  const RayCourse& course;
  const PostRows& posts;
  std::size_t step = 0;
  const RayLook* looks = nullptr;  ///< the first of the step's

  /// Goes on over the stretch. `place` is the observer's post, `eye` is the height of the eye; `from` and `to` are the
  /// heights of the ground at the edges, if the cell is whole.
  void pass(std::ptrdiff_t place, double eye, double from, double to, RayState& state) const;
};

}  // namespace itin::viewshed
