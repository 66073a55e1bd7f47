// How much detail a query wants: one tolerance, or rings of tolerance about a centre.
//
//   const Detail full = Detail::tolerance(0);  // every stored point
//   // Within 500 m everything, within 2 km to 1 m, beyond that to 4 m.
//   const Detail rings = Detail::rings({318000, 176000}, {{500, 0}, {2000, 1}, {10000, 4}});
#pragma once

#include <vector>

#include <itin/geometry.hpp>

namespace itin {

struct Ring {
  double radius = 0;     ///< metres from the centre
  double tolerance = 0;  ///< metres; beyond the last ring, its tolerance still holds
};

class Detail {
 public:
  /// Throws InputError unless metres is finite and >= 0.
  static Detail tolerance(double metres);
  /// Takes the nearest ring first. Throws InputError unless radii grow, tolerances do not shrink, and there is at least
  /// one ring.
  static Detail rings(Point2 centre, std::vector<Ring> rings);

  Point2 centre() const { return centre_; }
  /// The rings, at least one; a plain tolerance is a single ring of infinite radius.
  const std::vector<Ring>& rings() const { return rings_; }
  double finest() const { return rings_.front().tolerance; }
  double coarsest() const { return rings_.back().tolerance; }

 private:
  Detail(Point2 centre, std::vector<Ring> rings) : centre_(centre), rings_(std::move(rings)) {}
  Point2 centre_;
  std::vector<Ring> rings_;
};

}  // namespace itin
