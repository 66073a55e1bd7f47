#include "workflows/dwellings/daylight.hpp"

#include <cmath>

#include <itin/degrees.hpp>

namespace itin::viewshed {

std::vector<profile::CalendarMinutes> daylight_at(const SunYear& year, const SkyAt& sky) {
  constexpr double kHalfOfDiscDeg = 16 / 60.0;
  const double least = std::sin(in_radians(-kHalfOfDiscDeg));
  std::vector<profile::CalendarMinutes> daylight;
  bool up = false;
  for (std::uint32_t minute = 0; minute < year.days() * SunYear::kMinutesOfDay; ++minute) {
    const bool was_up = up && minute % SunYear::kMinutesOfDay != 0;
    up = sky.apparent(year.direction(minute)).z >= least;
    if (!up) continue;
    if (!was_up) daylight.push_back({minute, 0});
    ++daylight.back().count;
  }
  return daylight;
}

}  // namespace itin::viewshed
