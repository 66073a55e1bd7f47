#include "workflows/dwellings/output/dwelling_calendar.hpp"

#include <algorithm>
#include <array>
#include <set>

#include <fmt/format.h>

#include <itin/celestial_body.hpp>
#include <itin/counted.hpp>

#include "workflows/dwellings/daylight.hpp"
#include "workflows/dwellings/flicker_clock.hpp"
#include "workflows/dwellings/output/dwelling_names.hpp"

namespace itin::viewshed {

namespace {

/// Colours that people with colour blindness tell apart, and the one of all further turbines.
constexpr std::array<Rgba, 7> kTurbineColours{{{0, 114, 178, 255},
                                               {213, 94, 0, 255},
                                               {0, 158, 115, 255},
                                               {204, 121, 167, 255},
                                               {86, 180, 233, 255},
                                               {230, 159, 0, 255},
                                               {120, 70, 150, 255}}};
constexpr Rgba kFurtherTurbines{125, 125, 125, 255};

/// A dwelling with the flicker of all, and nothing else.
Dwelling all_together(const DwellingsSurvey& survey) {
  Dwelling all = {.position = survey.dwellings.front().position};
  for (const Dwelling& dwelling : survey.dwellings)
    for (const DwellingFacade& facade : dwelling.facades)
      all.facades.push_back({.ground_m = facade.ground_m, .flicker = facade.flicker});
  return all;
}

std::vector<profile::CalendarMinutes> minutes_of(const Dwelling& dwelling, std::size_t turbine) {
  std::vector<profile::CalendarMinutes> minutes;
  for (const FlickerRun& run : flicker_runs(dwelling, turbine)) minutes.push_back({run.first, run.minutes});
  return minutes;
}

}  // namespace

std::vector<ColouredTurbine> coloured_turbines(const Dwelling& dwelling) {
  std::vector<ColouredTurbine> coloured;
  for (const std::size_t turbine : flickering_turbines(dwelling)) {
    coloured.push_back({turbine, 0, kFurtherTurbines});
    for (const FlickerRun& run : flicker_runs(dwelling, turbine)) coloured.back().minutes += run.minutes;
  }
  std::stable_sort(coloured.begin(), coloured.end(),
                   [](const ColouredTurbine& a, const ColouredTurbine& b) { return a.minutes > b.minutes; });
  for (std::size_t i = 0; i < std::min(coloured.size(), kTurbineColours.size()); ++i)
    coloured[i].colour = kTurbineColours[i];
  return coloured;
}

CalendarMaker::CalendarMaker(const DwellingsSurvey& survey, const Progress& progress)
    : survey_(survey),
      to_geographic_(survey.metadata.crs_wkt, body_of(survey.metadata.crs_wkt).geographic_crs),
      year_(survey.request.flicker.year, progress) {}

profile::FlickerCalendar CalendarMaker::calendar(const Dwelling& dwelling) const {
  profile::FlickerCalendar calendar;
  calendar.year = survey_.request.flicker.year.year;
  calendar.clock = clock_name(survey_.request.flicker.year);
  calendar.daylight = daylight_at(year_, SkyAt(to_geographic_(dwelling.position), dwelling.facades.front().ground_m));
  std::size_t further = 0;
  for (const ColouredTurbine& coloured : coloured_turbines(dwelling)) {
    const auto minutes = minutes_of(dwelling, coloured.turbine);
    if (further == 0)
      calendar.turbines.push_back(
          {name_of_turbine(survey_.request.turbines.turbines[coloured.turbine]), coloured.colour, minutes});
    if (coloured.colour != kFurtherTurbines) continue;
    auto& last = calendar.turbines.back();
    if (further > 0) last.flicker.insert(last.flicker.end(), minutes.begin(), minutes.end());
    if (++further > 1) last.name = fmt::format("{} more turbines", further);
  }
  return calendar;
}

profile::FlickerCalendar CalendarMaker::of(const Dwelling& dwelling) const {
  profile::FlickerCalendar of_dwelling = calendar(dwelling);
  of_dwelling.title = fmt::format("Shadow flicker in {}, worst case", of_dwelling.year);
  of_dwelling.note = fmt::format("Times are {}. Sunrise and sunset are those over a level horizon.", of_dwelling.clock);
  of_dwelling.limit_minutes_day = survey_.request.flicker.limit_minutes_day;
  return of_dwelling;
}

profile::FlickerCalendar CalendarMaker::of_all() const {
  profile::FlickerCalendar of_run = calendar(all_together(survey_));
  of_run.title = fmt::format("Shadow flicker of {} at any of {} in {}, worst case",
                             counted(survey_.request.turbines.turbines.size(), "turbine"),
                             counted(survey_.dwellings.size(), "dwelling"), of_run.year);
  of_run.note = fmt::format("Times are {}. Sunrise and sunset are those over a level horizon at the first dwelling.",
                            of_run.clock);
  return of_run;
}

}  // namespace itin::viewshed
