#include "workflows/dwellings/output/dwelling_tables.hpp"

#include <iterator>
#include <set>

#include <fmt/format.h>

#include <itin/calendar_day.hpp>
#include <itin/csv_cell.hpp>

#include "workflows/dwellings/flicker_clock.hpp"

namespace itin::viewshed {

namespace {

std::string dwelling_cells(const Dwelling& dwelling) {
  return csv_cell(dwelling.name) + "," + csv_cell(dwelling.id);
}

const char* limits_word(const FlickerSum& sum) {
  if (sum.over_year) return sum.over_day ? "year and day" : "year";
  return sum.over_day ? "day" : "none";
}

/// hours,days,worst_day,worst_day_minutes,over_limit,likely_hours
std::string flicker_cells(const DwellingsSurvey& survey, const FlickerSum& sum) {
  const std::string likely = sum.likely ? fmt::format("{:.2f}", *sum.likely / 60) : "";
  const std::string worst =
      sum.days > 0 ? iso_day_text(day_of_year(survey.request.flicker.year.year, sum.worst_day)) : "";
  return fmt::format("{:.2f},{},{},{},{},{}", sum.hours(), sum.days, worst, sum.worst_minutes, limits_word(sum),
                     likely);
}
constexpr const char* kFlickerColumns =
    "flicker_hours,flicker_days,worst_day,worst_day_minutes,over_limit,likely_hours";

std::string turbine_cells(const DwellingsSurvey& survey, std::size_t turbine) {
  const Turbine& t = survey.request.turbines.turbines[turbine];
  return fmt::format("{},{}", t.number, csv_cell(t.name));
}

/// The turbines with flicker at a dwelling, ascending.
std::set<std::size_t> flickering(const Dwelling& dwelling) {
  std::set<std::size_t> turbines;
  for (const DwellingFacade& facade : dwelling.facades)
    for (const TurbineFlicker& flicker : facade.flicker) turbines.insert(flicker.turbine);
  return turbines;
}

}  // namespace

DwellingCounts counts_of(const DwellingsSurvey& survey) {
  DwellingCounts counts{.all = survey.dwellings.size()};
  for (const Dwelling& dwelling : survey.dwellings) {
    const FlickerSum sum = flicker_sum(survey, dwelling);
    counts.with_flicker += sum.minutes > 0;
    counts.over_year += sum.over_year, counts.over_day += sum.over_day;
  }
  return counts;
}

std::string dwellings_csv(const DwellingsSurvey& survey) {
  std::string text =
      fmt::format("name,id,theme,x,y,facades,nearest_turbine,nearest_name,nearest_m,{}\n", kFlickerColumns);
  for (const Dwelling& d : survey.dwellings)
    fmt::format_to(std::back_inserter(text), "{},{},{:.3f},{:.3f},{},{},{:.3f},{}\n", dwelling_cells(d),
                   d.theme == 0 ? "" : csv_cell(survey.metadata.themes[d.theme - std::size_t{1}].name), d.position.x,
                   d.position.y, d.theme == 0 ? 0 : d.facades.size(), turbine_cells(survey, d.nearest), d.nearest_m,
                   flicker_cells(survey, flicker_sum(survey, d)));
  return text;
}

std::string flicker_csv(const DwellingsSurvey& survey) {
  std::string text = fmt::format("name,id,turbine,turbine_name,{}\n", kFlickerColumns);
  for (const Dwelling& dwelling : survey.dwellings)
    for (const std::size_t turbine : flickering(dwelling))
      fmt::format_to(std::back_inserter(text), "{},{},{}\n", dwelling_cells(dwelling), turbine_cells(survey, turbine),
                     flicker_cells(survey, flicker_sum(survey, dwelling, turbine)));
  return text;
}

std::string calendar_csv(const DwellingsSurvey& survey) {
  std::string text = "name,id,date,from,to,minutes,turbine,turbine_name\n";
  for (const Dwelling& dwelling : survey.dwellings) {
    for (const std::size_t turbine : flickering(dwelling)) {
      for (const FlickerRun& run : flicker_runs(dwelling, turbine)) {
        const std::uint32_t day = run.first / SunYear::kMinutesOfDay, minute = run.first % SunYear::kMinutesOfDay;
        fmt::format_to(std::back_inserter(text), "{},{},{},{},{},{}\n", dwelling_cells(dwelling),
                       iso_day_text(day_of_year(survey.request.flicker.year.year, day)), clock_text(minute),
                       clock_text(minute + run.minutes), run.minutes, turbine_cells(survey, turbine));
      }
    }
  }
  return text;
}

}  // namespace itin::viewshed
