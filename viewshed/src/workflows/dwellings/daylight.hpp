// When the sun is up at a place, day by day of a year.
//
//   const SunYear year({.year = 2027, .utc_offset_minutes = 60}, progress);
//   calendar.daylight = daylight_at(year, SkyAt({-3.18, 51.48}, 50));
#pragma once

#include <vector>

#include <itin/sun.hpp>
#include <profile/flicker_calendar.hpp>

#include "turbines/sun_behind_rotor.hpp"

namespace itin::viewshed {

/// Returns the minutes between sunrise and sunset over a level horizon, in stretches that days end: in the middle of
/// each minute some of the sun's disc is up.
std::vector<profile::CalendarMinutes> daylight_at(const SunYear& year, const SkyAt& sky);

}  // namespace itin::viewshed
