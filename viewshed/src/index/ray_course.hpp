// The course of a ray over the posts of a lattice: which edges of the lattice's triangles it crosses one after the
// other, and where the ground between them is looked at. The course is that of every observer that stands at the same
// place of its cell of posts.
//
//   RayFan fan{.spacing = ..., .radius = ..., .rings = 400, ...};
//   const RayCourse course(fan, azimuth, posts, observers);
//   walk_ray(course, posts, instructions, walk);
//
// The disc about an observer is cut into rings of equal width, and a ray looks at the ground in the middle of each. A
// look counts as much as its ring has area: 1, 3, 5, ... from the innermost on.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <itin/lattice_tin.hpp>

#include "index/post_rows.hpp"

namespace itin::viewshed {

/// More rings would count more than a double can tell apart, when many are summed.
inline constexpr std::uint32_t kMostRings = 1 << 15;

/// What all rays of an index have in common. Lengths and heights are in grid units.
struct RayFan {
  double east = 0, south = 0;  ///< where observers stand in their cell of posts, both in [0, 1)
  double spacing = 1;          ///< between posts
  double radius = 1;
  std::uint32_t rings = 1;
  double reach = 1;          ///< beyond it there is no ground, whichever the observer
  double target_height = 0;  ///< above the ground
  double drop = 0;           ///< the drop's coefficient, per grid unit
  double grazing = 0;        ///< kGrazing

  double ring_width() const { return radius / rings; }
};

/// An edge that the ray crosses, and what lies between it and the edge before. Distances are from the observer.
struct RayStep {
  std::ptrdiff_t first, second;  ///< the ends of the edge, counted from the observer's post
  std::ptrdiff_t cell;           ///< the cell before the edge, likewise
  double weight;                 ///< how near to the second end the edge is crossed, 0 to 1
  double distance, per_distance;
  double drop;            ///< the drop at that distance
  double before;          ///< the distance of the edge before; 0 at the first
  double drop_before;     ///< the drop there
  double ratio;           ///< `before`, divided by what lies between
  LatticeTin::Half half;  ///< the half of a whole cell that is crossed before the edge
  std::uint32_t looks;    ///< how many of the course's looks fall between the edges
};

/// A place where the ground is looked at.
struct RayLook {
  double distance, per_distance;
  double drop;
  double share;   ///< how far the place lies on the way between the edges, 0 to 1
  double weight;  ///< a whole number
};

/// The cell before an edge, counted from the observer's post, and where the ray crosses it: from (u, v) to (next_u,
/// next_v), in cells east and south of its north-western post.
struct RayCrossing {
  std::int64_t column = 0, row = 0;
  double u = 0, v = 0, next_u = 0, next_v = 0;
};

/// Steps one after the other, over which no ground is higher than some height.
struct RayBlock {
  std::size_t last_step = 0;  ///< the first step beyond it
  std::uint32_t looks = 0;
  double nearest = 0, farthest = 0;  ///< 1 / distance, at both ends
  double least_drop = 0;             ///< the least drop in it, divided by its distance
  double ceiling = 0;                ///< no post that it meets is higher, from whichever observer; grid units
};

class RayCourse {
 public:
  /// The course from each of `observers`, which are places of the posts. The azimuth is clockwise from grid north,
  /// radians. No multiple of a right angle or half of one will do, for rays must not run along edges.
  RayCourse(const RayFan& fan, double azimuth, const PostRows& posts, const PostBox& observers);

  const RayFan& fan() const { return fan_; }
  const std::vector<RayStep>& steps() const { return steps_; }
  /// The looks of all steps, from the observer outwards.
  const std::vector<RayLook>& looks() const { return looks_; }
  /// Returns what all looks count together.
  double weight() const { return weight_; }
  /// Returns the cell that the course crosses in a step.
  const RayCrossing& crossing(std::size_t step) const { return crossings_[step]; }
  /// Returns all steps in blocks.
  const std::vector<RayBlock>& blocks() const { return blocks_; }
  /// Tells whether all cells that it crosses are whole, from whichever observer.
  bool whole() const { return whole_; }

 private:
  void end_block(const PostRows& posts, const PostBox& met);

  RayFan fan_;
  std::vector<RayStep> steps_;
  std::vector<RayLook> looks_;
  double weight_ = 0;
  std::vector<RayCrossing> crossings_;
  std::vector<RayBlock> blocks_;
  bool whole_ = true;
};

}  // namespace itin::viewshed
