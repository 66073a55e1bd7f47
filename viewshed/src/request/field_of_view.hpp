// Which targets an observer looks at: ranges of distance, azimuth and elevation, its own or the request's.
#pragma once

#include <cmath>
#include <optional>
#include <utility>

#include <itin/azimuth.hpp>
#include <itin/degrees.hpp>
#include <itin/grazing.hpp>
#include <viewshed/request.hpp>

#include "line/infinity.hpp"

namespace itin::viewshed {

class FieldOfView {
 public:
  FieldOfView(const Request& request, const Observer& observer)
      : azimuth_(observer.azimuth ? observer.azimuth : request.azimuth),
        elevation_(observer.elevation ? observer.elevation : request.elevation),
        drop_(request.earth.drop_coefficient()) {
    if (const auto radius = observer.radius ? observer.radius : request.radius) farthest_ = *radius * *radius;
    const double nearest = observer.min_radius.value_or(request.min_radius);
    nearest_ = nearest * nearest;
  }

  /// The distance beyond which nothing is in view, metres.
  double farthest() const { return std::sqrt(farthest_); }
  /// Whether anything at this squared distance or beyond it can be in view.
  bool reaches(double squared) const { return squared <= farthest_; }

  /// Whether everything between two squared distances is in view, at all heights.
  bool holds(double nearest, double farthest) const {
    return !azimuth_ && !elevation_ && nearest >= nearest_ && farthest <= farthest_;
  }

  /// Tells whether a target at this offset from the observer, metres (Eye::offset_to), is in view. An observer's own
  /// place has every azimuth. There the eye itself has every elevation, and other targets are straight above or below.
  bool contains(double dx, double dy, double dz) const { return contains(dx, dy, dz, dz).value(); }
  bool faces(double azimuth_deg) const { return !azimuth_ || azimuth_within(azimuth_deg); }
  /// The range of heights above the eye, metres, in which a target at this squared distance is in view; nothing: any
  /// height.
  std::optional<std::pair<double, double>> heights_at(double squared) const {
    if (!elevation_) return std::nullopt;
    const double distance = std::sqrt(squared), drop = drop_ * squared, slack = squared == 0 ? kGrazing : 0;
    const auto height = [&](double degrees) { return std::tan(in_radians(degrees)) * distance + drop; };
    return std::pair(elevation_->from <= -90 ? -kInfinity : height(elevation_->from) - slack,
                     elevation_->to >= 90 ? kInfinity : height(elevation_->to) + slack);
  }
  /// The elevation of a place in degrees: -90 or 90 for an observer's own place, and 0 for the eye itself.
  double elevation(double dx, double dy, double dz) const { return elevation_at(dx * dx + dy * dy, dz); }
  /// Tells whether a target somewhere from `low` to `high` above the observer is in view; nothing where that depends on
  /// its height.
  std::optional<bool> contains(double dx, double dy, double low, double high) const {
    const double squared = dx * dx + dy * dy;
    if (squared > farthest_ || squared < nearest_) return false;
    if (squared == 0 && low <= kGrazing && high >= -kGrazing) return true;
    if (squared > 0 && azimuth_ && !azimuth_within(in_degrees(std::atan2(dx, dy)))) return false;
    if (!elevation_) return true;
    const double lowest = elevation_at(squared, low), highest = elevation_at(squared, high);
    if (lowest >= elevation_->from && highest <= elevation_->to) return true;
    if (highest < elevation_->from || lowest > elevation_->to) return false;
    return std::nullopt;
  }

 private:
  bool azimuth_within(double degrees) const {
    const double width = within_turn(azimuth_->to - azimuth_->from);
    // A whole turn has width 0, but is no empty range.
    if (width == 0 && azimuth_->to != azimuth_->from) return true;
    return within_turn(degrees - azimuth_->from) <= width;
  }
  double elevation_at(double squared, double dz) const {
    if (squared == 0 && std::abs(dz) <= kGrazing) return 0;
    return in_degrees(std::atan2(dz - drop_ * squared, std::sqrt(squared)));
  }

  std::optional<AngleRange> azimuth_;
  std::optional<AngleRange> elevation_;
  double drop_;
  double farthest_ = kInfinity;
  double nearest_ = 0;
};

}  // namespace itin::viewshed
