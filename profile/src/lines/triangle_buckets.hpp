// A grid of buckets over a Tin, to find the triangles near a line.
#pragma once

#include <cstdint>
#include <vector>

#include <itin/tin.hpp>

namespace itin::profile {

/// Immutable and safe for concurrent use. About two triangles per bucket; a triangle is in every bucket its box meets.
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
  template <typename Visit>
  void for_each_bucket(const Tin& tin, std::uint32_t triangle, const Visit& visit) const;

  Box bounds_;
  double side_ = 1;  ///< of a bucket, metres
  int column_count_ = 0;
  int row_count_ = 0;
  std::vector<std::uint32_t> first_;  ///< of each bucket, row by row, and one past the last
  std::vector<std::uint32_t> triangles_;
};

}  // namespace itin::profile
