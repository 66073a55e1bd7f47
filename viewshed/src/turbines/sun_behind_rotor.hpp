// When the sun stands behind a rotor, minute by minute of a year, as seen from an eye.
//
//   const SunYear year({.year = 2026, .utc_offset_minutes = 60}, progress);
//   for (const SunMinute& m : sun_behind(year, eye, rotor, 3))
//     ...                                            // m.direction: to where the sun is seen in minute m.minute
//
// The rotor is a disc that faces the eye, and the sun a point, as the rules for shadow flicker have them: the sun is
// behind the rotor where the ray to the sun passes the hub no farther away than the rotor's radius. The sun stands
// where it does in the middle of the minute.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <itin/geometry.hpp>
#include <itin/progress.hpp>
#include <itin/sun.hpp>
#include <viewshed/dwellings.hpp>

namespace itin::viewshed {

/// The sun in each minute of a year. Takes 13 MB.
class SunYear {
 public:
  /// Throws Cancelled.
  SunYear(const FlickerYear& year, const Progress& progress);

  static constexpr std::uint32_t kMinutesOfDay = 1440;
  std::uint32_t days() const { return static_cast<std::uint32_t>(directions_.size()) / kMinutesOfDay; }
  /// As sun_direction() has it, in a minute of the year.
  const Point3& direction(std::uint32_t minute) const { return directions_[minute]; }

 private:
  std::vector<Point3> directions_;
};

/// An eye that the sun shines at.
struct SunEye {
  SkyAt sky;
  double convergence = 0;               ///< how far grid north lies clockwise of true north, radians
  std::optional<double> outward_deg{};  ///< grid azimuth to which the wall looks that the eye is before
};

/// A rotor as the eye sees it: its hub to grid east, grid north and up of the eye, less the Earth's drop.
struct SeenRotor {
  Point3 hub;
  double radius = 0;
};

struct SunMinute {
  std::uint32_t minute = 0;  ///< counted from the beginning of the year
  Point3 direction;          ///< unit vector: grid east, grid north, up
};

/// Returns the minutes in which the sun is behind the rotor and no lower than `least_elevation_deg`, which must not be
/// negative; before the eye's wall alone where it has one.
std::vector<SunMinute> sun_behind(const SunYear& year, const SunEye& eye, const SeenRotor& rotor,
                                  double least_elevation_deg);

}  // namespace itin::viewshed
