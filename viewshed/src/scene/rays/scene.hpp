// Sight lines against a Tin by rays, decided exactly: Embree finds which triangles a line may meet, double precision
// decides whether one hides it.
//
//   const Scene scene(tin, earth);
//   SightLines lines;                        // up to 16, as close together as possible
//   unsigned hidden = scene.hidden(lines);   // one bit for each line
//
// Embree holds a tree of boxes, one about each triangle and all that lies under it: a triangle hides whatever is below
// it. Heights are those about the Tin's centre, less the Earth's drop there, in which sight lines are straight from
// every eye at once (the drops about two places differ by a plane). A box ends above all of its triangle, which bulges
// over its corners then by at most drop L^2 / 3 for its longest edge L.
//
// Why no triangle is missed. Let u = 2^-24, X the greatest coordinate about the centre. Lines are clipped in double
// precision to the part that lies about the surface, so that a ray's coordinates are no greater than X, wherever the
// eye is. Each of a ray's ends is rounded by u X along each axis, its direction by as much again, and the parameter at
// which Embree's ray passes a side of a box, (side - origin) / direction, errs by what a shift of the side by
// 8 u X makes: three roundings of each product. A line that meets a triangle is at that parameter within the box in
// each axis; hence boxes that are wider by 16 u X on each side are met. Heights need no wider boxes: both ends of
// the ray are lowered by 16 u (Z + |z| at either end), Z the greatest height. All boxes begin at one floor below the
// surface; a line that goes below that is cast level at the floor, where it meets every box along its way. What a
// packet's callback leaves out in single precision (ray_sieve.hpp) is left out by the same bounds.
//
// So every triangle that hides a line is asked, in double precision, whatever the instruction set, the threads and the
// shape of the tree: these cannot change an answer.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include <itin/earth.hpp>
#include <itin/grazing.hpp>
#include <itin/tin.hpp>

#include "line/instructions.hpp"
#include "line/sight_lines.hpp"

namespace itin::viewshed {

/// The triangle that hid the last block: it most often hides the next one, too.
struct Occluder {
  std::optional<std::uint32_t> triangle;
};

/// A part of a line, as fractions of its length.
struct Stretch {
  double from = 0;
  double to = 1;
};

/// Safe for concurrent use.
class Scene {
 public:
  /// Lines are hidden that the surface rises above by more than `grazing` metres. The Tin must outlive the scene.
  /// Throws std::bad_alloc.
  Scene(const Tin& tin, const Earth& earth, double grazing = kGrazing,
        Instructions instructions = instructions_here().back());
  Scene(Scene&&) noexcept;
  Scene& operator=(Scene&&) noexcept;
  ~Scene();

  /// Returns one bit per line: 1 if it is hidden. Only bits of active lines are set.
  unsigned hidden(const SightLines& lines) const;
  /// Returns one bit for each four lines, which must be all active or all not: 1 where one triangle hides all four. It
  /// then also hides whatever lies at or below the convex hull of their ends. For what a convex body hides from a point
  /// is convex, and with heights less the drop at their distance lines are straight and the ground under a triangle is
  /// convex. (Where refraction bends lines more than the Earth does, the ground is not convex, and no bit is set.)
  unsigned hidden_together(const SightLines& lines, Occluder& occluder) const;
  /// Finds for each active line the parts that lie over triangles that hide it, in any order.
  using Stretches = std::array<std::vector<Stretch>, SightLines::kSize>;
  void find_hidden(const SightLines& lines, Stretches& result) const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace itin::viewshed
