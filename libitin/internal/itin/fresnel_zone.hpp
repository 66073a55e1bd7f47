// How much of the first Fresnel zone is clear along one line: the definition that profiles and siting share (law 4).
//
//   const LineOverGround line(120.5, 98.0, 1, drop * length * length);   // distances are fractions of the length
//   LeastFraction least(std::sqrt(wavelength * length), kGrazing);
//   least.consider(t, line.clearance({t, ground}));                  // a place of the ground
//   least.consider_inside(line.piece({t, ground}, {u, height}));     // straight ground between two places
//   if (least.least() && least.least()->fraction < 0.6) ...
//
// Distances are fractions t of the line's length; heights, clearances and the zone's radius share one unit. Between two
// places the clearance is a quadratic of t, and its least ratio to the radius is at a root of a cubic: nothing is
// sampled. Source: ITU-R P.526-15 section 2.
#pragma once

#include <cmath>
#include <optional>

#include <itin/clearance.hpp>

namespace itin {

/// The least ratio, over all places considered, of clearance to the first zone's radius, radius_unit sqrt(t (1 - t)).
/// At the ends the radius is 0: there a clearance within `touching` of 0 counts as a ratio of 0, and any other does not
/// count.
class LeastFraction {
 public:
  struct Place {
    double fraction = 0;
    double t = 0;
    double clearance = 0;
  };

  /// Takes sqrt(wavelength times length) as `radius_unit`: twice the greatest radius.
  LeastFraction(double radius_unit, double touching) : unit_(radius_unit), touching_(touching) {}

  void consider(double t, double clearance);
  /// Considers the places between the piece's ends; the ends themselves count by consider() only.
  void consider_inside(const ClearancePiece& piece);
  /// Returns the place with the least ratio; among equals, the one considered first.
  const std::optional<Place>& least() const { return least_; }

 private:
  bool is_greater_along(const ClearancePiece& piece) const;

  double unit_, touching_;
  std::optional<Place> least_;
};

}  // namespace itin
