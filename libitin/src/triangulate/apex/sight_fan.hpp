// Finds segments that cross a line of sight from one eye, for many such lines: only segments in the line's narrow
// sector, as seen from the eye, are tested. Every answer is exact.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <itin/bucket_lists.hpp>

#include "geometry/predicates.hpp"
#include "store/codec/point_index.hpp"

namespace itin {

class SightFan {
 public:
  /// Takes a or b as the eye; all lines of sight lead to the left of ab. The segments must outlive it. O(n) for n
  /// segments that are short as seen from the eye.
  SightFan(Position a, Position b, Position eye, std::span<const Segment> segments);

  /// Tells whether some segment properly crosses the line of sight to c.
  bool blocked(Position c) const;

 private:
  struct Sectors {
    std::uint32_t first, last;
  };
  double pseudo_angle(double x, double y) const;
  Sectors sectors_of(const Segment& s) const;
  std::uint32_t sector(double angle) const;

  Position eye_;
  double along_x_, along_y_;  ///< the unit vector from a to b
  std::span<const Segment> segments_;
  std::uint32_t count_;
  BucketLists in_sector_;  ///< numbers of segments
};

}  // namespace itin
