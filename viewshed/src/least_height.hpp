// How high the far end of a sight line must be to be seen: the least height at which nothing hides it.
//
//   LeastHeights heights(tin, earth, scene);
//   LeastHeights::Memory memory;                                    // kept from packet to packet
//   const auto least = heights.find(lines, lower, memory);          // NaN where even lines.to_z is hidden
//
// Method. An occluding triangle says exactly at which height of the end the line clears it (SightLine::clearing_end),
// and the least height is the greatest of these over all triangles under the line. Rays decide quickly where even the
// upper height is hidden; elsewhere a branch and bound over a pyramid of greatest heights finds that maximum, for all
// lines of a packet at once, pruned by what hid the neighbouring packet. There is no step size: the result touches one
// triangle and clears all.
//
// Accuracy. Double precision throughout: the line at the height found has a clearance between -kGrazing and 0, up to
// rounding, or the height is the lower bound. So it agrees with Scene::hidden_between and with single lines of sight.
#pragma once

#include <array>
#include <cstdint>

#include <itin/earth.hpp>
#include <itin/tin.hpp>

#include "height_pyramid.hpp"
#include "scene.hpp"
#include "sight_line.hpp"
#include "sight_lines.hpp"

namespace itin::viewshed {

/// Safe for concurrent use, each thread with its own Memory.
class LeastHeights {
 public:
  /// Tin and scene must outlive it; the scene is of that Tin and Earth.
  LeastHeights(const Tin& tin, const Earth& earth, const Scene& scene);

  using Heights = std::array<double, SightLines::kSize>;
  static constexpr std::uint32_t kNone = 0xffffffff;
  /// What hid the last lines.
  struct Memory {
    Memory() { silhouettes.fill(kNone); }
    Occluder occluder;                                         ///< at the upper height
    std::array<std::uint32_t, SightLines::kSize> silhouettes;  ///< of each line at the least height
  };

  /// For each active line the least height of its end `to` in grid units, from `lower` up to lines.to_z, at which it is
  /// not hidden; NaN where it is hidden at lines.to_z too (behind a curtain, whatever its height), and for lines that
  /// are not active. A lower bound above lines.to_z counts as lines.to_z. Cost: about a microsecond a line that is
  /// not hidden, a twentieth for others.
  Heights find(const SightLines& lines, const Heights& lower, Memory& memory) const;

 private:
  struct Search;

  const Tin& tin_;
  const Scene& scene_;
  double drop_;     ///< grid units of drop a squared grid unit
  double grazing_;  ///< grid units
  HeightPyramid pyramid_;
};

}  // namespace itin::viewshed
