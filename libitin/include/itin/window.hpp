// The region a query asks for: box, polygon with holes, disc, wedge or corridor.
//
//   const Window disc = Window::disc({318000, 176000}, 5000);
//   const Tin tin = triangulate(store, disc, Detail::tolerance(2), progress);
//
// A window is a closed region of the plane. A triangle belongs to the answer when it meets the window (touching
// counts). Shapes are kept as polygons in metres and quantised to the store's grid once, so that membership is decided
// exactly: a disc is the regular polygon of kArcSides sides around it (it contains the disc), a wedge has its arc cut
// into as many parts, in proportion. Quantising moves corners by at most half a grid step per axis.
//
// Every function that makes a window throws InputError, naming the shape, when a coordinate is not a finite number
// within kLimit of 0 or when the shape has no area.
#pragma once

#include <vector>

#include <itin/geometry.hpp>

namespace itin {

class Window {
 public:
  static constexpr int kArcSides = 256;
  static constexpr double kLimit = 1e12;  ///< metres; every coordinate and length lies within it

  using Ring = std::vector<Point2>;  ///< closed implicitly, either orientation
  struct Polygon {
    Ring outer;
    std::vector<Ring> holes;
  };
  /// Returns the corners of a box as a part; unlike box(), it also takes a box without area.
  static Polygon rectangle(const Box& b);

  /// Everything the store covers.
  static Window all();
  static Window box(const Box& b);
  /// Returns the union of the parts, which may overlap. Within a part, rings may touch. Throws InputError if edges
  /// cross (found where double arithmetic is sure of it), or if a ring has fewer than three distinct corners.
  /// O(n log n) for n edges that are short against the whole.
  static Window polygons(std::vector<Polygon> parts);
  static Window disc(Point2 centre, double radius);
  /// Returns the sector about the direction `azimuth`, width / 2 to either side. Azimuths count clockwise from grid
  /// north, degrees; `width` is in (0, 360].
  static Window wedge(Point2 apex, double azimuth, double width, double radius);
  /// Returns the rectangle of all points within width / 2 to either side of the line and between its ends.
  static Window corridor(Point2 from, Point2 to, double width);

  bool is_all() const { return all_; }
  const std::vector<Polygon>& parts() const { return parts_; }
  /// Returns an empty box for `all()`.
  Box bounds() const;
  /// Tells whether a position lies within a part and none of its holes; on an edge, the answer may be either.
  /// O(corners).
  bool contains(Point2 position) const;

 private:
  bool all_ = false;
  std::vector<Polygon> parts_;
};

}  // namespace itin
