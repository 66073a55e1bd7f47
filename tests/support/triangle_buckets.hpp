// A grid of buckets over a Tin, to find the triangles near a line.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include <itin/bucket_lists.hpp>
#include <itin/sort_unique.hpp>
#include <itin/tin.hpp>

namespace itin::test {

/// A grid of buckets. Immutable and safe for concurrent use. It has about two triangles per bucket; a triangle is in
/// every bucket its box meets.
class TriangleBuckets {
 public:
  explicit TriangleBuckets(const Tin& tin);

  /// All triangles that meet the segment ab, and others nearby; ascending, each once.
  std::vector<std::uint32_t> near(Point2 a, Point2 b) const;

 private:
  /// Widens searches by a part of a bucket, so that rounding of the line's course never loses a triangle.
  static constexpr double kSlack = 1e-6;

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

inline TriangleBuckets::TriangleBuckets(const Tin& tin) {
  if (tin.triangles.empty()) return;
  bounds_ = tin.bounds();
  const double area = bounds_.width() * bounds_.height();
  side_ = std::max(std::sqrt(2 * area / static_cast<double>(tin.triangles.size())), tin.grid.resolution);
  column_count_ = static_cast<int>(bounds_.width() / side_) + 1;
  row_count_ = static_cast<int>(bounds_.height() / side_) + 1;

  triangles_ = {static_cast<std::size_t>(column_count_) * row_count_, tin.triangles.size(),
                [&](std::uint32_t t, const auto& add) {
                  Box box;
                  for (const std::uint32_t v : tin.triangles[t]) {
                    const Point3 p = tin.point(v);
                    box.extend(Point2{p.x, p.y});
                  }
                  const Span across = columns(box.xmin, box.xmax), up = rows(box.ymin, box.ymax);
                  for (int row = up.first; row <= up.last; ++row)
                    for (int column = across.first; column <= across.last; ++column) add(bucket(column, row));
                }};
}

inline TriangleBuckets::Span TriangleBuckets::columns(double xmin, double xmax) const {
  const double last = column_count_ - 1;
  const auto column = [&](double x) { return static_cast<int>(std::clamp((x - bounds_.xmin) / side_, 0.0, last)); };
  return {column(xmin - kSlack * side_), column(xmax + kSlack * side_)};
}

inline TriangleBuckets::Span TriangleBuckets::rows(double ymin, double ymax) const {
  const double last = row_count_ - 1;
  const auto row = [&](double y) { return static_cast<int>(std::clamp((y - bounds_.ymin) / side_, 0.0, last)); };
  return {row(ymin - kSlack * side_), row(ymax + kSlack * side_)};
}

inline std::vector<std::uint32_t> TriangleBuckets::near(Point2 a, Point2 b) const {
  std::vector<std::uint32_t> found;
  if (b.x < a.x) std::swap(a, b);
  Box course;
  course.extend(a);
  course.extend(b);
  if (!course.meets(bounds_)) return found;

  const double slope = (b.y - a.y) / (b.x - a.x);
  // The ends are treated first, for within a column of its own a line due north has no slope.
  const auto y_at = [&](double x) { return x <= a.x ? a.y : x >= b.x ? b.y : a.y + slope * (x - a.x); };
  const Span across = columns(a.x, b.x);
  for (int column = across.first; column <= across.last; ++column) {
    const double left = bounds_.xmin + (column - kSlack) * side_, right = left + (1 + 2 * kSlack) * side_;
    const double y0 = y_at(left), y1 = y_at(right);
    const Span up = rows(std::min(y0, y1), std::max(y0, y1));
    for (int row = up.first; row <= up.last; ++row) {
      const auto inside = triangles_.in(bucket(column, row));
      found.insert(found.end(), inside.begin(), inside.end());
    }
  }
  sort_unique(found);
  return found;
}

}  // namespace itin::test
