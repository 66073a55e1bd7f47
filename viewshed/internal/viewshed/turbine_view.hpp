// The view that an eye has of one turbine, and of several together.
#pragma once

#include <vector>

#include <viewshed/turbines.hpp>

namespace itin::viewshed {

/// The angle of an upright axis between two heights at horizontal distance `distance`, as seen from `eye`: degrees.
/// Heights are elevations, the drop by curvature not yet taken off.
double vertical_angle_deg(const Earth& earth, double distance, double eye, double low, double high);

/// The arc of a rotor that faces the eye.
Arc rotor_arc(Point2 eye, Point2 turbine, double rotor_diameter);

struct RotorHorizon {
  Arc held;             ///< the smallest arc that holds all
  double occupied = 0;  ///< degrees that their union covers
};

/// Takes at least one arc; `arcs` is left in another order.
RotorHorizon rotor_horizon(std::vector<Arc>& arcs);

}  // namespace itin::viewshed
