#include "workflows/dwellings/output/dwelling_tables.hpp"

#include <cmath>
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

/// The columns of what is seen; {0} stands for the surface.
constexpr const char* kViewColumns =
    "hubs_visible{0},tips_visible{0},hubs_undecided{0},tips_undecided{0},nearest_visible_turbine{0},nearest_visible{0}_"
    "m,"
    "horizontal_from{0}_deg,horizontal_extent{0}_deg,vertical_angle{0}_deg";

std::string view_columns() {
  return fmt::format(kViewColumns, "") + "," + fmt::format(kViewColumns, "_screened");
}

std::string hubs_cell(const std::optional<std::size_t>& count) {
  return count ? fmt::format("{}", *count) : "";
}

/// Empty cells where nothing was looked at.
std::string view_cells(const DwellingsSurvey& survey, Point2 from, const std::optional<SightSummary>& view) {
  if (!view) return ",,,,,,,,";
  std::string cells = fmt::format("{},{},{},{},", hubs_cell(view->hubs), view->tips, hubs_cell(view->hubs_undecided),
                                  view->tips_undecided);
  if (!view->nearest_seen) return cells + ",,,,0";
  const Turbine& nearest = survey.request.turbines.turbines[*view->nearest_seen];
  return cells + fmt::format("{},{:.1f},{:.2f},{:.2f},{:.3f}", nearest.number,
                             std::hypot(nearest.position.x - from.x, nearest.position.y - from.y), view->arc->from,
                             view->arc->width, view->vertical_deg);
}

/// Over the bare ground, and over the surface with the themes: what a dwelling sees, or a facade.
template <class Looker>
std::string views_cells(const DwellingsSurvey& survey, const Looker& looker) {
  return view_cells(survey, looker.position, view_of(survey, looker, SightSurface::kBare)) + "," +
         view_cells(survey, looker.position, view_of(survey, looker, SightSurface::kScreened));
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
    const auto sees_a_tip = [&](SightSurface surface) {
      const auto view = view_of(survey, dwelling, surface);
      return view && view->tips > 0;
    };
    counts.see_a_tip += sees_a_tip(SightSurface::kBare),
        counts.see_a_tip_screened += sees_a_tip(SightSurface::kScreened);
  }
  return counts;
}

std::string dwellings_csv(const DwellingsSurvey& survey) {
  std::string text = fmt::format("name,id,theme,x,y,facades,nearest_turbine,nearest_name,nearest_m,{},{}\n",
                                 kFlickerColumns, view_columns());
  for (const Dwelling& d : survey.dwellings)
    fmt::format_to(std::back_inserter(text), "{},{},{:.3f},{:.3f},{},{},{:.3f},{},{}\n", dwelling_cells(d),
                   d.theme == 0 ? "" : csv_cell(survey.metadata.themes[d.theme - std::size_t{1}].name), d.position.x,
                   d.position.y, d.theme == 0 ? 0 : d.facades.size(), turbine_cells(survey, d.nearest), d.nearest_m,
                   flicker_cells(survey, flicker_sum(survey, d)), views_cells(survey, d));
  return text;
}

std::string facades_csv(const DwellingsSurvey& survey) {
  std::string text =
      fmt::format("name,id,facade,x,y,ground_m,outward_grid_deg,length_m,turbines_before,{}\n", view_columns());
  for (const Dwelling& d : survey.dwellings) {
    for (std::size_t f = 0; f < d.facades.size(); ++f) {
      const DwellingFacade& facade = d.facades[f];
      const auto bare = view_of(survey, facade, SightSurface::kBare);
      fmt::format_to(std::back_inserter(text), "{},{},{:.3f},{:.3f},{:.3f},{},{:.1f},{},{}\n", dwelling_cells(d), f + 1,
                     facade.position.x, facade.position.y, facade.ground_m, csv_cell(facade.outward_deg, 1),
                     facade.length_m, bare ? bare->turbines : 0, views_cells(survey, facade));
    }
  }
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
