// The shadow flicker of a survey as calendars, with a colour for each turbine.
//
//   const CalendarMaker calendars(survey, progress);
//   profile::draw_flicker_calendar(calendars.of_all(), "calendar.png");
#pragma once

#include <cstddef>
#include <vector>

#include <itin/coordinates.hpp>
#include <itin/progress.hpp>
#include <profile/flicker_calendar.hpp>
#include <viewshed/dwellings.hpp>

#include "turbines/sun_behind_rotor.hpp"

namespace itin::viewshed {

/// A turbine, its minutes, and its colour in a calendar and on the map beside it.
struct ColouredTurbine {
  std::size_t turbine = 0;  ///< its index in the request
  std::uint32_t minutes = 0;
  Rgba colour;
};

/// The turbines with flicker at a dwelling, those with the most minutes first. All but the first few share a colour.
std::vector<ColouredTurbine> coloured_turbines(const Dwelling& dwelling);

class CalendarMaker {
 public:
  /// The survey must outlive this object. Throws Cancelled.
  CalendarMaker(const DwellingsSurvey& survey, const Progress& progress);

  /// The calendar of a dwelling, between its sunrise and sunset, with the limit for a day.
  profile::FlickerCalendar of(const Dwelling& dwelling) const;
  /// When each turbine's shadow flickers at any of the dwellings.
  profile::FlickerCalendar of_all() const;

 private:
  profile::FlickerCalendar calendar(const Dwelling& dwelling) const;

  const DwellingsSurvey& survey_;
  CoordinateTransform to_geographic_;
  SunYear year_;
};

}  // namespace itin::viewshed
