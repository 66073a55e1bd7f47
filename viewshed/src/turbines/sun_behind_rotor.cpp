#include "turbines/sun_behind_rotor.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>

#include <itin/degrees.hpp>
#include <itin/parallel.hpp>

namespace itin::viewshed {

namespace {

constexpr double kMinutesPerTurn = SunYear::kMinutesOfDay;

double length_of(const Point3& v) {
  return std::hypot(v.x, v.y, v.z);
}

/// Turns about the upright axis, clockwise as seen from above.
Point3 turned(const Point3& v, double angle) {
  const double sine = std::sin(angle), cosine = std::cos(angle);
  return {v.x * cosine + v.y * sine, v.y * cosine - v.x * sine, v.z};
}

/// Where the eye's wall looks, a unit vector; nothing in the open.
std::optional<Point2> outward_of(const SunEye& eye) {
  if (!eye.outward_deg) return std::nullopt;
  const double azimuth = in_radians(*eye.outward_deg);
  return Point2{std::sin(azimuth), std::cos(azimuth)};
}

/// How far a place lies before the wall that looks outward.
double ahead_of(Point2 outward, const Point3& place) {
  return place.x * outward.x + place.y * outward.y;
}

/// The minutes of a day, a superset of those in which the sun is within some angle of a fixed direction.
class NearMinutes {
 public:
  NearMinutes(const Point3& towards, double angle)
      : sine_(towards.z), cosine_(std::hypot(towards.x, towards.y)), east_(std::atan2(towards.y, towards.x)) {
    least_cosine_ = std::cos(std::min(angle + kMargin, std::numbers::pi));
  }

  /// Calls visit(first, end) for stretches of minutes of the day, given where the sun is at its noon.
  template <class Visit>
  void on_day(const Point3& noon, const Visit& visit) const {
    const double across = cosine_ * std::hypot(noon.x, noon.y), along = sine_ * noon.z;
    const double cosine_of_turn = across > 0 ? (least_cosine_ - along) / across : -1;
    if (cosine_of_turn > 1) return;
    constexpr double kSlack = 2;
    const double half = std::acos(std::max(cosine_of_turn, -1.0)) / (2 * std::numbers::pi) * kMinutesPerTurn + kSlack;
    // The sun goes westward, once round in a day.
    const double behind = (std::atan2(noon.y, noon.x) - east_) / (2 * std::numbers::pi) * kMinutesPerTurn;
    const double middle = kMinutesPerTurn / 2 + behind;
    if (2 * half >= kMinutesPerTurn - 2) return visit(std::uint32_t{0}, SunYear::kMinutesOfDay);
    for (const double turn : {-kMinutesPerTurn, 0.0, kMinutesPerTurn}) {
      const double first = std::max(0.0, std::floor(middle + turn - half)),
                   end = std::min(kMinutesPerTurn, std::ceil(middle + turn + half));
      if (first < end) visit(static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(end));
    }
  }

 private:
  /// In half a day the sun's declination changes by 0.2 degrees and its time by 0.07; refraction differs by at most 0.5
  /// degrees across the sky.
  static constexpr double kMargin = in_radians(0.9);

  double sine_, cosine_, east_, least_cosine_;
};

}  // namespace

SunYear::SunYear(const FlickerYear& year, const Progress& progress) {
  using std::chrono::sys_days;
  const std::chrono::year first{year.year};
  const sys_days begin{first / 1 / 1}, end{(first + std::chrono::years{1}) / 1 / 1};
  const auto days = static_cast<std::size_t>((end - begin).count());
  directions_.resize(days * kMinutesOfDay);
  const auto midnight = std::chrono::sys_seconds{begin} - std::chrono::minutes{year.utc_offset_minutes};
  parallel_for(days, [&](std::size_t day) {
    progress.throw_if_cancelled();
    for (std::size_t minute = day * kMinutesOfDay; minute < (day + 1) * kMinutesOfDay; ++minute)
      directions_[minute] =
          sun_direction(julian_day(midnight + std::chrono::minutes{minute} + std::chrono::seconds{30}));
  });
}

std::vector<SunMinute> sun_behind(const SunYear& year, const SunEye& eye, const SeenRotor& rotor,
                                  double least_elevation_deg) {
  constexpr double kSlack = 1e-6;
  std::vector<SunMinute> minutes;
  const auto outward = outward_of(eye);
  if (outward && ahead_of(*outward, rotor.hub) + rotor.radius < -kSlack) return minutes;
  const double distance = length_of(rotor.hub), reach = rotor.radius * rotor.radius;
  const Point3 hub = turned(rotor.hub, eye.convergence);  // to true east and north
  const double angle = distance > rotor.radius ? std::asin(rotor.radius / distance) : std::numbers::pi;
  // Elevations below the least are left out as soon as the true one is lower by more than any refraction.
  const double least = std::sin(in_radians(least_elevation_deg)),
               lowest = std::sin(in_radians(least_elevation_deg - 1));
  const auto add_if_behind = [&](std::uint32_t minute) {
    const Point3& sun = year.direction(minute);
    if (eye.sky.local(sun).z < lowest) return;
    const Point3 seen = eye.sky.apparent(sun);
    const double along = hub.x * seen.x + hub.y * seen.y + hub.z * seen.z;
    if (seen.z < least || along <= 0 || distance * distance - along * along > reach) return;
    const Point3 direction = turned(seen, -eye.convergence);
    if (outward && ahead_of(*outward, direction) <= 0) return;
    minutes.push_back({minute, direction});
  };
  const Point3 unit = distance > 0 ? Point3{hub.x / distance, hub.y / distance, hub.z / distance} : Point3{0, 0, 1};
  const NearMinutes near(eye.sky.of_earth(unit), angle);
  for (std::uint32_t day = 0; day < year.days(); ++day) {
    const std::uint32_t midnight = day * SunYear::kMinutesOfDay;
    near.on_day(year.direction(midnight + SunYear::kMinutesOfDay / 2), [&](std::uint32_t first, std::uint32_t end) {
      for (std::uint32_t m = first; m < end; ++m) add_if_behind(midnight + m);
    });
  }
  return minutes;
}

}  // namespace itin::viewshed
