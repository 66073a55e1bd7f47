// Polygons on the grid, and what footprints need done to them. The only place that knows GEOS.
//
// Coordinates are grid positions throughout. Computed places are rounded to the grid as by snap rounding, so results
// are valid polygons whose edges lie within a grid step of the exact ones. Every function is free of shared state and
// may run on many threads. All of them can be stopped (stoppable.hpp), though GEOS takes some seconds to notice within
// an outline of a million corners (the program does not wait for it).
#pragma once

#include <utility>
#include <vector>

#include <itin/error.hpp>
#include <itin/geometry.hpp>

#include "geometry/predicates.hpp"

namespace itin {

/// Tells that GEOS gave up, as it does on a few outlines about as small as the grid, or that lines cross too often. The
/// functions below may throw it.
class OverlayError : public Error {
 public:
  using Error::Error;
};

/// A ring of positions, of which the first is not repeated at the end.
using GridRing = std::vector<Position>;

/// The outline runs counterclockwise, holes clockwise: the inside is always to the left.
struct GridPolygon {
  GridRing outline;
  std::vector<GridRing> holes;
};

using GridPolygons = std::vector<GridPolygon>;
using GridEdge = std::pair<Position, Position>;

/// Calls visit(ring) for the outline and each hole.
template <class Visit>
void for_each_ring(const GridPolygon& polygon, const Visit& visit) {
  visit(polygon.outline);
  for (const GridRing& hole : polygon.holes) visit(hole);
}
/// Calls visit(a, b) for each directed edge.
template <class Visit>
void for_each_edge(const GridPolygon& polygon, const Visit& visit) {
  for_each_ring(polygon, [&](const GridRing& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) visit(ring[i], ring[(i + 1) % ring.size()]);
  });
}

/// The area in square grid units.
double area(const GridPolygon& polygon);
double area(const GridPolygons& polygons);

enum class Side { outside, border, inside };
/// Tells the side, exactly.
Side side_of(const GridPolygon& polygon, Position p);
/// Tells by the even-odd rule whether p, which may lie anywhere, is inside. Borders are as exact as floating point. For
/// many positions see polygon_sides.hpp.
bool covers(const GridPolygons& polygons, Point2 p);

struct EvenOdd {
  GridPolygons polygons;
  bool repaired = false;  ///< the rings crossed or touched themselves or each other
};
/// The area that rings enclose, which may be empty. Throws OverlayError where they cross more often than
/// most_conflicts() (planarity.hpp), before any memory is spent on it.
EvenOdd even_odd(const std::vector<GridRing>& rings);
/// The area that parts enclose together, each by the even-odd rule of its own rings. Parts may overlap, and their order
/// does not matter. Throws OverlayError as even_odd() does.
EvenOdd union_of(std::vector<std::vector<GridRing>> parts);

/// A bounded face of an arrangement, with a position inside it.
struct PlanFace {
  GridPolygon polygon;
  Point2 inside;
};
/// The faces of edges that meet only at their ends; edges that bound no face are passed over.
std::vector<PlanFace> faces_of(const std::vector<GridEdge>& edges);

/// The union of polygons that have no area in common and meet at shared edges; vertices stay.
GridPolygons united(const GridPolygons& faces);
/// The union of any polygons.
GridPolygons merged(const GridPolygons& polygons);
/// All positions further than `distance` from the outside; corners stay sharp.
GridPolygons eroded(const GridPolygons& polygons, double distance);
GridPolygons common_part(const GridPolygons& a, const GridPolygons& b);

/// A line as a band, square at its ends. Throws OverlayError where it crosses itself too often, as even_odd() does.
GridPolygons thickened(const std::vector<Position>& line, double thickness);

/// The smallest rectangle about a ring, as its centre, half sides and the direction (a unit vector) of the longer.
struct Rectangle {
  Point2 centre, axis;
  double half_length = 0, half_width = 0;
};
Rectangle enclosing_rectangle(const GridRing& ring);

}  // namespace itin
