// Exact lines of sight on a triangulated surface: the reference that every faster answer is measured against.
//
//   const Tin tin = triangulate(store, Window::all(), Detail::tolerance(0), progress);
//   const profile::SightLines sight_lines(tin, Earth());
//   const profile::SightLine sight = sight_lines.between({310375, 183525, 309}, {322300, 190000, 285});
//   if (!sight.visible()) std::cout << "hidden at " << sight.critical.x << ", " << sight.critical.y << '\n';
//
// The vertical plane through both ends cuts the surface into straight pieces, one per triangle. Within a piece the
// clearance, the height of the ray above the surface, is a quadratic of the distance: the ray and the piece are
// straight, and the drop of the earth's curvature is quadratic. So its least value is found in closed form, and nothing
// is sampled. Refraction bends the ray by the same quadratic; see itin/earth.hpp. With a wavelength, the clear part of
// the first Fresnel zone is found as well.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include <itin/earth.hpp>
#include <itin/geometry.hpp>
#include <itin/tin.hpp>

namespace itin::profile {

struct SightLine {
  double length = 0;  ///< metres, horizontal
  /// The least height, in metres, of the ray above the surface between the ends, both included; nothing where no ground
  /// lies between them. Where the ends are at one place (nearer than a step of the grid), only the ends count.
  std::optional<double> clearance;
  /// The least clearance / F1 between the ends, as fresnel_clearance() gives it; nothing without a wavelength, and
  /// where no ground lies between them.
  std::optional<double> fresnel_fraction;
  /// The place on the surface where the clearance is least; among several places, the one nearest to the end that comes
  /// first in (x, y, z).
  Point3 critical;

  /// Whether the line is visible. A ray that grazes the surface is, and so is one over ground without data.
  bool visible() const;
  /// Whether it is visible, and at least this fraction of the first Fresnel zone is clear.
  bool clears(double fraction) const { return visible() && (!fresnel_fraction || *fresnel_fraction >= fraction); }
};

/// Finds lines of sight on a surface. Immutable and safe for concurrent use. Refers to the Tin, which must outlive it.
class SightLines {
 public:
  /// Takes O(n) time and memory in the triangles.
  SightLines(const Tin& tin, const Earth& earth, std::optional<double> wavelength = std::nullopt);
  SightLines(const Tin&& tin, const Earth& earth, std::optional<double> wavelength = std::nullopt) = delete;
  SightLines(SightLines&&) noexcept;
  SightLines& operator=(SightLines&&) noexcept;
  ~SightLines();

  /// Looks from one end to the other. Both are positions with an elevation, in metres. Exchanging them gives the same
  /// result to the last bit. Cost: the triangles near the line, about the square root of n for one across the whole
  /// surface. Accuracy: double precision throughout; clearances are good to 1e-6 m over 1000 km and to 1e-9 m over 1
  /// km.
  SightLine between(Point3 a, Point3 b) const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace itin::profile
