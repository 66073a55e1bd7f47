// Places where turbines may stand: spaced over an area, apart along and across the wind, away from dwellings.
//
//   const std::vector<Point2> places = spaced_positions(area, 200);
//   const TurbineSpacing spacing{.along = 5 * rotor, .across = 3 * rotor, .wind_from_deg = 240};
//   if (spacing.keeps_apart(places[0], places[1]) && !dwellings.any_within(places[0], 500)) ...
//
// Distances are horizontal, on the grid of the CRS.
#pragma once

#include <optional>
#include <vector>

#include <itin/geometry.hpp>
#include <itin/window.hpp>
#include <viewshed/site_plan.hpp>

namespace itin::viewshed {

/// Returns the middles of the squares of this side, metres, whose edges lie on multiples of it, where they are within
/// the area; from the north-west. Throws InputError where there is none, or there are too many.
std::vector<Point2> spaced_positions(const Window& area, double side);

/// Dwellings as points or as polygons.
class Dwellings {
 public:
  Dwellings(std::vector<Point2> points, std::optional<Window> polygons);

  /// Returns how far the nearest dwelling is, 0 within one, or `most` where none is nearer.
  double metres_to(Point2 position, double most) const;
  /// Tells whether a dwelling is nearer than `metres`, or the position lies within one.
  bool any_within(Point2 position, double metres) const { return metres_to(position, metres) < metres; }

 private:
  std::vector<Point2> points_;
  struct Polygon {
    Window outline;
    Box bounds;
  };
  std::vector<Polygon> polygons_;
};

}  // namespace itin::viewshed
