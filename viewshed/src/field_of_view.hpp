// Which targets an observer looks at: ranges of distance, azimuth and elevation.
#pragma once

#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include <viewshed/viewshed.hpp>

namespace itin::viewshed {

class FieldOfView {
 public:
  explicit FieldOfView(const Request& request)
      : azimuth_(request.azimuth), elevation_(request.elevation), drop_(request.earth.drop_coefficient()) {
    if (request.radius) farthest_ = *request.radius * *request.radius;
    nearest_ = request.min_radius * request.min_radius;
  }

  /// Metres from the observer to the target. An observer's own position has every azimuth.
  bool contains(double dx, double dy, double dz) const { return contains(dx, dy, dz, dz).value(); }
  /// A target somewhere from `low` to `high` above the observer; nothing where that decides.
  std::optional<bool> contains(double dx, double dy, double low, double high) const {
    const double squared = dx * dx + dy * dy;
    if (squared > farthest_ || squared < nearest_) return false;
    if (squared == 0) return true;
    if (azimuth_ && !azimuth_within(dx, dy)) return false;
    if (!elevation_) return true;
    const double lowest = elevation_at(squared, low), highest = elevation_at(squared, high);
    if (lowest >= elevation_->from && highest <= elevation_->to) return true;
    if (highest < elevation_->from || lowest > elevation_->to) return false;
    return std::nullopt;
  }

 private:
  static constexpr double kDegrees = 180 / std::numbers::pi;

  bool azimuth_within(double dx, double dy) const {
    const double width = turn(azimuth_->to - azimuth_->from);
    // A range of a whole turn is given as such, not as nothing.
    if (width == 0 && azimuth_->to != azimuth_->from) return true;
    return turn(std::atan2(dx, dy) * kDegrees - azimuth_->from) <= width;
  }
  double elevation_at(double squared, double dz) const {
    return std::atan2(dz - drop_ * squared, std::sqrt(squared)) * kDegrees;
  }
  static double turn(double degrees) {
    const double rest = std::fmod(degrees, 360);
    return rest < 0 ? rest + 360 : rest;
  }

  std::optional<AngleRange> azimuth_;
  std::optional<AngleRange> elevation_;
  double drop_;
  double farthest_ = std::numeric_limits<double>::infinity();
  double nearest_ = 0;
};

}  // namespace itin::viewshed
