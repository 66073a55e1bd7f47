// Which sight lines leave a given fraction of the first Fresnel zone clear.
//
//   const ClearZone zone(lower, upper, earth, {.wavelength = 0.06, .fraction = 0.6});
//   unsigned cut = zone.certainly_cut(to_highest_targets);        // whatever the full surface is: one bit per line
//   unsigned clear = zone.certainly_clear(to_lowest_targets);
//
// Ground that rises above the line lowered by the fraction of the zone's radius cuts the zone. Over the curved Earth
// the lowered line is convex in the distance, so that a tangent bounds it from below over whole blocks of triangles.
// The few triangles that are left, near an end or a ridge, are judged one by one in double precision, by the definition
// that lines of sight have (itin/fresnel_zone.hpp). Raising a target only clears more.
#pragma once

#include <cstdint>
#include <optional>

#include <itin/earth.hpp>
#include <itin/fresnel_zone.hpp>
#include <itin/tin.hpp>
#include <viewshed/request.hpp>

#include "bounds/height_pyramid.hpp"
#include "line/sight_line.hpp"
#include "line/sight_lines.hpp"

namespace itin::viewshed {

class ClearZone {
 public:
  using Pyramid = std::shared_ptr<const HeightPyramid>;
  /// The surface lies between the two, which are Tins, or is `lower` itself: then `upper` is null.
  ClearZone(Pyramid lower, Pyramid upper, const Earth& earth, const FresnelCriterion& criterion);

  /// Returns one bit per line; the closer together the lines' ends, the faster. Over the surface itself a zone is
  /// either certainly cut or certainly clear. May be called from any number of threads.
  unsigned certainly_cut(const SightLines& to_highest_targets) const;
  /// Returns one bit per line, and tells nothing of the lines themselves across ground without data.
  unsigned certainly_clear(const SightLines& to_lowest_targets) const;

  /// The triangle that cuts a zone nearest to the line's start.
  struct FirstCut {
    std::uint32_t triangle = 0;
    double at = 0;  ///< fraction of the line's length where the line comes over the triangle
  };
  /// Returns nothing where no triangle of the lower surface cuts the zone of a line between ends in grid units.
  std::optional<FirstCut> first_cut(const Point3& from, const Point3& to) const;

 private:
  unsigned cut(const HeightPyramid& surface, const SightLines& lines) const;
  double zone_of(const SightLine& line) const;

  double drop_;  ///< grid units per squared grid unit
  FresnelCriterion criterion_;
  Pyramid lower_, upper_;
};

}  // namespace itin::viewshed
