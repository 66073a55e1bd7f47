// Which sight lines certainly clear a surface, and where the other lines come near it.
//
//   UpperScene scene(upper, {}, drift, earth);
//   unsigned doubtful = scene.touched(lines);      // a line whose bit is 0 clears the surface
//
// Accuracy. Rays are cast in single precision with both ends lowered by e(l) of scene.hpp, so that heights need no
// care. Sideways a ray may run delta(l) beside its line: the surface must have been raised against that, as Envelope
// does, and is made wider here where it ends. Both ends must lie above the surface, which the caller sees to: a line
// that runs beneath it from end to end crosses nothing.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include <itin/earth.hpp>
#include <itin/tin.hpp>

#include "bounds/boundary.hpp"
#include "line/sight_lines.hpp"

namespace itin::viewshed {

/// A part of a line, as fractions of its length.
struct Stretch {
  double from = 0;
  double to = 1;
};

/// Safe for concurrent use.
class UpperScene {
 public:
  /// The Tin must outlive the scene, and may consist of overlapping pieces: `pieces` has the first triangle of each
  /// piece except the first. `drift` is how far rays may run beside their lines, grid units. Throws std::bad_alloc.
  UpperScene(const Tin& tin, std::vector<std::uint32_t> pieces, double drift, const Earth& earth);
  UpperScene(UpperScene&&) noexcept;
  UpperScene& operator=(UpperScene&&) noexcept;
  ~UpperScene();

  /// Returns one bit per line: 0 if it clears the surface, 1 if it may not.
  unsigned touched(const SightLines& lines) const;
  /// For each active line, stretches that hold every part that does not clear the surface, except for a millimetre at
  /// its ends. `starts_under` and `ends_under`: lines whose end is not above the surface.
  using Stretches = std::array<std::vector<Stretch>, SightLines::kSize>;
  void find_stretches(const SightLines& lines, unsigned starts_under, unsigned ends_under, Stretches& result) const;
  /// e(l) in grid units for a line of `length` grid units.
  double error_bound(double length) const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace itin::viewshed
