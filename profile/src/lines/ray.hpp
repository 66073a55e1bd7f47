// The straight ray over the curved ground: the one place where clearances are computed, so that every answer about a
// sight line is the same to the last bit (law 4).
#pragma once

#include <optional>

namespace itin::profile {

/// A place of the ground under the ray.
struct GroundPoint {
  double distance = 0;  ///< metres from the ray's start
  double z = 0;
};

class Ray {
 public:
  /// `drop`: Earth::drop_coefficient().
  Ray(double start_z, double end_z, double length, double drop)
      : start_z_(start_z), end_z_(end_z), length_(length), drop_(drop) {}

  double length() const { return length_; }

  /// From the nearer end, so that a level ray is level and the ray from the other end the same.
  double height(double distance) const {
    const double left = length_ - distance;
    if (length_ == 0) return start_z_;
    if (distance == left) return (start_z_ + end_z_) / 2;
    return distance < left ? start_z_ + (end_z_ - start_z_) * (distance / length_)
                           : end_z_ + (start_z_ - end_z_) * (left / length_);
  }

  /// The earth's surface bulges above the chord between both ends by drop d1 d2.
  double clearance(const GroundPoint& p) const {
    return height(p.distance) - p.z - drop_ * (p.distance * (length_ - p.distance));
  }

  /// Where over the straight ground from a to b the clearance is least, if that is between them: over a curved earth
  /// it is a convex quadratic.
  std::optional<GroundPoint> lowest_between(const GroundPoint& a, const GroundPoint& b) const {
    const double width = b.distance - a.distance;
    if (width <= 0 || drop_ <= 0) return std::nullopt;
    const double slope = (end_z_ - start_z_) / length_ - (b.z - a.z) / width;
    const double distance = (length_ - slope / drop_) / 2;
    if (distance <= a.distance || distance >= b.distance) return std::nullopt;
    return GroundPoint{distance, a.z + (distance - a.distance) / width * (b.z - a.z)};
  }

 private:
  double start_z_, end_z_, length_, drop_;
};

/// The least clearance over pieces of ground, and where it is: among several places, the one nearest to the ray's
/// start.
struct LeastClearance {
  std::optional<double> clearance;
  GroundPoint place;

  void consider(const Ray& ray, const GroundPoint& p) {
    const double c = ray.clearance(p);
    if (clearance && (c > *clearance || (c == *clearance && p.distance >= place.distance))) return;
    clearance = c;
    place = p;
  }
  void consider(const Ray& ray, const GroundPoint& a, const GroundPoint& b) {
    consider(ray, a);
    consider(ray, b);
    if (const auto lowest = ray.lowest_between(a, b)) consider(ray, *lowest);
  }
};

}  // namespace itin::profile
