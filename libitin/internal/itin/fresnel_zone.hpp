// How much of the first Fresnel zone is clear along one ray: the definition that profiles and siting share (law 4).
//
//   const RayOverGround ray{120.5, 98.0, bulge};              // elevations of its ends; drop times squared length
//   LeastFraction least(std::sqrt(wavelength * length));
//   least.consider(t, ray.clearance(t, ground));               // a place of the ground
//   least.consider_inside(ray.piece(t, ground, u, height));    // straight ground between two places
//   if (least.least() && least.least()->fraction < 0.6) ...
//
// Distances are fractions t of the ray's length; heights, clearances and the zone's radius are in one unit, whichever.
// Between two places the clearance is a quadratic of t, and its least ratio to the radius is at a root of a cubic:
// nothing is sampled. Source: ITU-R P.526-15 section 2.
#pragma once

#include <cmath>
#include <optional>

namespace itin {

/// One straight piece of ground under a ray: with t in [from, to] the clearance is constant + linear t + square t^2.
struct RayPiece {
  double from = 0, to = 0;
  double constant = 0, linear = 0, square = 0;

  double at(double t) const { return constant + t * (linear + t * square); }
};

/// A straight ray; the Earth's surface bulges above the chord between its ends by bulge t (1 - t).
struct RayOverGround {
  double from_z = 0, to_z = 0;
  double bulge = 0;  ///< Earth::drop_coefficient() times the squared length

  double clearance(double t, double ground) const { return from_z * (1 - t) + to_z * t - ground - bulge * t * (1 - t); }
  /// Precondition: from < to.
  RayPiece piece(double from, double from_ground, double to, double to_ground) const {
    const double slope = (to_ground - from_ground) / (to - from);
    return {from, to, from_z - (from_ground - slope * from), to_z - from_z - slope - bulge, bulge};
  }
};

/// The least ratio of clearance to the first zone's radius, radius_unit sqrt(t (1 - t)), of what it was shown. At the
/// ends the radius is 0: there a clearance of 0 counts as 0, any other not at all.
class LeastFraction {
 public:
  struct Place {
    double fraction = 0;
    double t = 0;
    double clearance = 0;
  };

  /// `radius_unit`: sqrt(wavelength times length), twice the greatest radius.
  explicit LeastFraction(double radius_unit) : unit_(radius_unit) {}

  void consider(double t, double clearance);
  /// Between the piece's ends, which count by consider() only.
  void consider_inside(const RayPiece& piece);
  /// Among equal places, the one considered first.
  const std::optional<Place>& least() const { return least_; }

 private:
  double unit_;
  std::optional<Place> least_;
};

}  // namespace itin
