// A grid of buckets over a Tin, to find the triangles near a line.
#pragma once

#include <cstdint>
#include <vector>

#include <itin/bucket_lists.hpp>
#include <itin/tin.hpp>

namespace itin::profile {

/// A grid of buckets. Immutable and safe for concurrent use. It has about two triangles per bucket; a triangle is in
/// every bucket its box meets.
class TriangleBuckets {
 public:
  explicit TriangleBuckets(const Tin& tin);

  /// All triangles that meet the segment ab, and others nearby; ascending, each once.
  std::vector<std::uint32_t> near(Point2 a, Point2 b) const;

 private:
  struct Span {
    int first = 0;
    int last = -1;
  };
  Span columns(double xmin, double xmax) const;
  Span rows(double ymin, double ymax) const;
  std::size_t bucket(int column, int row) const { return static_cast<std::size_t>(row) * column_count_ + column; }

  Box bounds_;
  double side_ = 1;  ///< the side of a bucket, metres
  int column_count_ = 0;
  int row_count_ = 0;
  BucketLists triangles_;  ///< by bucket, row by row
};

}  // namespace itin::profile
