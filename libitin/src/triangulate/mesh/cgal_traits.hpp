// The geometric traits that let CGAL's planar triangulations run on grid positions. Include only where CGAL may appear.
#pragma once

#include <cstdint>
#include <istream>
#include <ostream>

#include <CGAL/enum.h>

#include "geometry/predicates.hpp"

namespace itin {

/// A numbered grid position.
struct TraitsPoint {
  std::int32_t x = 0;
  std::int32_t y = 0;
  std::uint32_t vertex = 0;
  friend bool operator==(const TraitsPoint& a, const TraitsPoint& b) { return a.x == b.x && a.y == b.y; }
  // CGAL's triangulations name these operators in stream operators that are never called here.
  friend std::ostream& operator<<(std::ostream& out, const TraitsPoint&) { return out; }
  friend std::istream& operator>>(std::istream& in, TraitsPoint&) { return in; }
};

/// A model of CGAL's DelaunayTriangulationTraits_2, without constructions.
struct GridTraits {
  using Point_2 = TraitsPoint;
  struct Segment_2 {};
  struct Triangle_2 {};
  struct Line_2 {};
  struct Ray_2 {};

  struct Orientation_2 {
    CGAL::Orientation operator()(const Point_2& a, const Point_2& b, const Point_2& c) const {
      return static_cast<CGAL::Orientation>(orientation(a, b, c));
    }
  };
  struct Compare_x_2 {
    CGAL::Comparison_result operator()(const Point_2& a, const Point_2& b) const {
      return static_cast<CGAL::Comparison_result>((a.x > b.x) - (a.x < b.x));
    }
  };
  struct Compare_y_2 {
    CGAL::Comparison_result operator()(const Point_2& a, const Point_2& b) const {
      return static_cast<CGAL::Comparison_result>((a.y > b.y) - (a.y < b.y));
    }
  };
  struct Side_of_oriented_circle_2 {
    CGAL::Oriented_side operator()(const Point_2& a, const Point_2& b, const Point_2& c, const Point_2& d) const {
      return static_cast<CGAL::Oriented_side>(in_circle(a, b, c, d));
    }
  };
  struct Construct_point_2 {
    const Point_2& operator()(const Point_2& p) const { return p; }
  };
  struct Construct_segment_2 {};
  struct Construct_triangle_2 {};
  struct Compare_distance_2 {};

  Orientation_2 orientation_2_object() const { return {}; }
  Compare_x_2 compare_x_2_object() const { return {}; }
  Compare_y_2 compare_y_2_object() const { return {}; }
  Side_of_oriented_circle_2 side_of_oriented_circle_2_object() const { return {}; }
  Construct_point_2 construct_point_2_object() const { return {}; }
};

}  // namespace itin
