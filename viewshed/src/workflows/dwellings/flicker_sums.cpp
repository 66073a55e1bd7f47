// What flicker comes to: hours, days, and the likely part of them.

#include <viewshed/dwellings.hpp>

#include "turbines/sun_behind_rotor.hpp"
#include "workflows/dwellings/flicker_clock.hpp"

namespace itin::viewshed {

FlickerSum flicker_sum(const DwellingsSurvey& survey, const Dwelling& dwelling,
                       const std::optional<std::size_t>& turbine) {
  constexpr std::uint32_t kDay = SunYear::kMinutesOfDay;
  const FlickerRules& rules = survey.request.flicker;
  FlickerSum sum;
  if (rules.months) sum.likely = 0;
  const std::vector<FlickerRun> runs = flicker_runs(dwelling, turbine);
  for (std::size_t i = 0; i < runs.size();) {
    const std::uint32_t day = runs[i].first / kDay;
    std::uint32_t minutes = 0;
    for (; i < runs.size() && runs[i].first / kDay == day; ++i) minutes += runs[i].minutes;
    sum.minutes += minutes, ++sum.days;
    if (minutes > sum.worst_minutes) sum.worst_minutes = minutes, sum.worst_day = day;
    if (!rules.months) continue;
    const MonthShare& share = (*rules.months)[static_cast<unsigned>(day_of_year(rules.year.year, day).month()) - 1];
    *sum.likely += minutes * share.sunshine * share.operation;
  }
  sum.over_year = sum.minutes > rules.limit_minutes_year, sum.over_day = sum.worst_minutes > rules.limit_minutes_day;
  return sum;
}

}  // namespace itin::viewshed
