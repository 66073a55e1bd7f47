// Finds what first hides a target from an eye: the triangle nearest to the eye that rises above the sight line.
//
//   const FirstBlocker blockers(std::make_shared<const HeightPyramid>(tin), earth);
//   const std::optional<FirstBlocker::Blocker> blocker = blockers.find(eye, target);
//
// Every triangle that may matter (HeightPyramid) is looked at in double precision, with SightLine's rule for grazing: a
// line that a viewshed reports hidden by ground has a blocker.
#pragma once

#include <cstdint>
#include <optional>

#include <itin/earth.hpp>
#include <itin/tin.hpp>

#include "bounds/height_pyramid.hpp"

namespace itin::viewshed {

/// Safe for concurrent use.
class FirstBlocker {
 public:
  /// The surface is a Tin.
  FirstBlocker(std::shared_ptr<const HeightPyramid> surface, const Earth& earth);

  struct Blocker {
    std::uint32_t triangle = 0;
    double at = 0;  ///< fraction of the line's length where the triangle first rises above it
  };
  /// Finds the first blocker between ends in grid units; nothing for a line that no ground hides. If several triangles
  /// begin to hide at one place, the first by number counts.
  std::optional<Blocker> find(const Point3& from, const Point3& to) const;

 private:
  std::shared_ptr<const HeightPyramid> surface_;
  double drop_;     ///< grid units of drop per squared grid unit
  double grazing_;  ///< grid units
};

}  // namespace itin::viewshed
