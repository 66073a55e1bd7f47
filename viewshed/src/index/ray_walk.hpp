// Walks a ray from the observers of a row, all at once: what each sees of the ground along it.
//
//   RayWalk walk{.place = posts.place(observer, row), .there = ..., .ground = ..., .eye = ...};
//   walk_ray(course, posts, instructions_here().back(), walk);
//   walk.seen[0];                  // how much the first of the observers sees, as the looks of the course count
//
// A look is decided as SightLine decides the line from the eye to it: it is hidden where the ground before it rises
// above that line by more than kGrazing. Against the eye, ground at the distance d has the slope (z - eye - drop d^2) /
// d; a look is hidden where ground before it has a greater one. Over a straight stretch of ground the slope is greatest
// at one of its ends or, where the Earth curves away beneath the line, once in between (RayStretch).
#pragma once

#include <array>
#include <cstddef>

#include "index/post_rows.hpp"
#include "index/ray_course.hpp"
#include "line/instructions.hpp"

namespace itin::viewshed {

/// A number for each of the observers that are looked from at once.
template <class T>
using OfObservers = std::array<T, PostRows::kTogether>;

/// Observers of a row, next to each other, and what they see along one ray. Heights are in grid units.
struct RayWalk {
  std::ptrdiff_t place = 0;                     ///< PostRows::place() of the first
  OfObservers<bool> there{};                    ///< whether somebody stands there; what others see means nothing
  alignas(64) OfObservers<double> ground{};     ///< height of the ground under each
  alignas(64) OfObservers<double> eye{};        ///< height of the eye of each
  alignas(64) OfObservers<double> looks{};      ///< how many looks fall on ground
  alignas(64) OfObservers<double> on_ground{};  ///< what these count
  alignas(64) OfObservers<double> seen{};       ///< what those count that are seen, and not beyond ground without data
  alignas(64) OfObservers<double> beyond{};     ///< what those count that ground without data alone could hide
};

/// Walks the course from all observers, who must be among those it was made for.
void walk_ray(const RayCourse& course, const PostRows& posts, Instructions instructions, RayWalk& walk);

}  // namespace itin::viewshed
