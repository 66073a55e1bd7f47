// How far one triangulated surface rises above another within a box: the overlay of both, made triangle by triangle.
//
//   const HeightDifference difference(low_mesh);
//   difference.add(high_mesh, t, box, extremes);     // triangle t, over as much of it as lies in the box
//
// This is slow and plain; pyramid/difference/overlay.hpp finds the same along edges in one walk, and for whole
// triangles. Neither surface has to have the other's vertices. It computes in extended precision, about a corner of the
// triangle: right to some 1e-5 grid units even where the surfaces are as steep as the grid allows.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include <itin/bucket_lists.hpp>

#include "triangulate/region/region.hpp"

namespace itin {

/// The extremes of a difference, grid units, and the place where it is greatest; empty at first.
struct Extremes {
  double lo = std::numeric_limits<double>::infinity();
  double hi = -std::numeric_limits<double>::infinity();
  Point2 highest;  ///< grid units

  bool empty() const { return lo > hi; }
  void add(double difference, Point2 at) {
    lo = std::min(lo, difference);
    if (difference > hi) hi = difference, highest = at;
  }
  void add(const Extremes& e) {
    lo = std::min(lo, e.lo);
    if (e.hi > hi) hi = e.hi, highest = e.highest;
  }
};

class HeightDifference {
 public:
  /// Measures heights above this surface, which must outlive it.
  explicit HeightDifference(const RegionMesh& low);

  void add(const RegionMesh& high, std::uint32_t triangle, const GridBox& box, Extremes& extremes) const;

 private:
  std::int64_t column(std::int32_t x) const { return (std::int64_t{x} - bounds_.xmin) / side_; }
  std::int64_t row(std::int32_t y) const { return (std::int64_t{y} - bounds_.ymin) / side_; }
  std::size_t bucket(std::int64_t column, std::int64_t row) const {
    return static_cast<std::size_t>(row * columns_ + column);
  }
  /// Calls visit(triangle) once for each triangle whose box meets this one.
  template <class Visit>
  void for_each_near(const GridBox& box, const Visit& visit) const;

  const RegionMesh& low_;
  GridBox bounds_;
  std::int64_t side_ = 1, columns_ = 0;  ///< the side of a bucket, grid units, and the number of buckets side by side
  BucketLists triangles_;                ///< by bucket
};

}  // namespace itin
