// Lines of sight on a triangulated surface, over every triangle under them: what faster answers are held against, to
// the last bit. ExactLineOfSight is the twin that shares no code with the libraries.
//
// The vertical plane through both ends cuts the surface into straight pieces, one per triangle. Within a piece the
// clearance, the height of the ray above the surface, is a quadratic of the distance: the ray and the piece are
// straight, and the drop of the earth's curvature is quadratic. So its least value is found in closed form, and nothing
// is sampled. Refraction bends the ray by the same quadratic; see itin/earth.hpp.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>

#include <itin/clearance.hpp>
#include <itin/earth.hpp>
#include <itin/grazing.hpp>
#include <itin/section_line.hpp>
#include <itin/tin.hpp>

#include "support/triangle_buckets.hpp"

namespace itin::test {

/// The least clearance over pieces of ground, and where it is: among several places, the one nearest to the line's
/// start.
struct LeastClearance {
  std::optional<double> clearance;
  GroundPoint place;

  void consider(const LineOverGround& line, const GroundPoint& p) {
    const double c = line.clearance(p);
    if (clearance && (c > *clearance || (c == *clearance && p.distance >= place.distance))) return;
    clearance = c;
    place = p;
  }
  void consider(const LineOverGround& line, const GroundPoint& a, const GroundPoint& b) {
    consider(line, a);
    consider(line, b);
    if (const auto lowest = line.lowest_between(a, b)) consider(line, *lowest);
  }
};

struct SightLine {
  double length = 0;  ///< metres, horizontal
  /// The least height, in metres, of the ray above the surface between the ends, both included; nothing where no ground
  /// lies between them. Where the ends are at one place (nearer than a step of the grid), only the ends count.
  std::optional<double> clearance;
  /// The place on the surface where the clearance is least; among several places, the one nearest to the end that comes
  /// first in (x, y, z).
  Point3 critical;

  /// Whether the line is visible. A ray that grazes the surface is, and so is one over ground without data.
  bool visible() const { return !clearance || *clearance >= -kGrazing; }
};

/// Finds lines of sight on a surface. Immutable and safe for concurrent use. Refers to the Tin, which must outlive it.
class SightLines {
 public:
  SightLines(const Tin& tin, const Earth& earth) : tin_(&tin), buckets_(tin), drop_(earth.drop_coefficient()) {}

  /// Looks from one end to the other. Both are positions with an elevation, in metres. Exchanging them gives the same
  /// result to the last bit. Cost: the triangles near the line, about the square root of n for one across the whole
  /// surface. Accuracy: double precision throughout; clearances are good to 1e-6 m over 1000 km and to 1e-9 m over 1
  /// km.
  SightLine between(Point3 a, Point3 b) const {
    const SectionLine line(tin_->grid, {a.x, a.y}, {b.x, b.y});
    // Whichever end was given first, all arithmetic is the same.
    if (line.is_mirrored() || (line.is_point() && b.z < a.z)) std::swap(a, b);
    const double length = line.length();
    const LineOverGround over_metres(a.z, b.z, length, drop_);
    LeastClearance least;
    for (const std::uint32_t t : buckets_.near(line.start(), line.end())) {
      const std::optional<SectionPiece> chord = line.chord(tin_->corners(t));
      if (!chord) continue;
      const std::optional<SectionPiece> piece = line.clip(chord->from, chord->to);
      if (!piece) continue;
      if (line.is_one_place()) {
        consider_ends(over_metres, *piece, least);
        continue;
      }
      least.consider(over_metres, {piece->from.distance, piece->from.position.z},
                     {piece->to.distance, piece->to.position.z});
    }
    SightLine result;
    result.length = length;
    result.clearance = least.clearance;
    if (least.clearance) result.critical = position(line, least.place);
    return result;
  }

 private:
  /// Considers ends at one place, which have no ground between them: only the ground at the ends counts.
  static void consider_ends(const LineOverGround& line, const SectionPiece& piece, LeastClearance& least) {
    for (const SectionCrossing* c : {&piece.from, &piece.to})
      if (c->t == 0 || c->t == 1) least.consider(line, GroundPoint{c->distance, c->position.z});
  }

  static Point3 position(const SectionLine& line, const GroundPoint& p) {
    const double t = line.length() > 0 ? p.distance / line.length() : 0;
    const Point2 a = line.start(), b = line.end();
    return {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), p.z};
  }

  const Tin* tin_;
  TriangleBuckets buckets_;
  double drop_;  ///< metres per square metre of distance
};

}  // namespace itin::test
