#include "workflows/dwellings/output/dwelling_sheet.hpp"

#include <cmath>

#include <fmt/format.h>

#include <itin/counted.hpp>
#include <itin/sources_in.hpp>
#include <viewshed/map_base.hpp>
#include <viewshed/result_sheet.hpp>

#include "workflows/dwellings/flicker_clock.hpp"
#include "workflows/dwellings/output/dwelling_names.hpp"
#include "workflows/dwellings/output/dwelling_plan.hpp"

namespace itin::viewshed {

namespace {

using Facts = std::vector<std::pair<std::string, std::string>>;

std::string with_undecided(std::size_t seen, std::size_t undecided) {
  return undecided > 0 ? fmt::format("{} ({}?)", seen, undecided) : fmt::format("{}", seen);
}

std::string hubs_text(const SightSummary& view) {
  return view.hubs ? with_undecided(*view.hubs, *view.hubs_undecided) : "unknown";
}
std::string tips_text(const SightSummary& view) {
  return with_undecided(view.tips, view.tips_undecided);
}

double bearing_behind(const Arc& arc) {
  return std::fmod(arc.from + arc.width, 360);
}

std::string view_text(const std::optional<SightSummary>& view) {
  if (!view) return "no turbine is before a facade";
  const std::string counts =
      fmt::format("tips: {} of {}, hubs: {}", tips_text(*view), view->turbines, hubs_text(*view));
  if (!view->arc) return counts;
  return fmt::format("{}; {:.1f}° of the horizon, from {:.1f}° to {:.1f}°; up to {:.2f}° high", counts,
                     view->arc->width, view->arc->from, bearing_behind(*view->arc), view->vertical_deg);
}

std::string limit_text(double limit, const char* unit, bool over) {
  return fmt::format("{} the limit of {:g} {}", over ? "beyond" : "within", limit, unit);
}

std::string date_on_sheet(const DwellingsSurvey& survey, std::uint32_t day) {
  return iso_day_text(day_of_year(survey.request.flicker.year.year, day));
}

std::string flicker_text(const DwellingsSurvey& survey, const FlickerSum& sum) {
  const FlickerRules& rules = survey.request.flicker;
  if (sum.minutes == 0) return "none";
  return fmt::format("{:.2f} h on {}, {}; {} min on {}, {}", sum.hours(), counted(sum.days, "day"),
                     limit_text(rules.limit_minutes_year / 60, "h in the year", sum.over_year), sum.worst_minutes,
                     date_on_sheet(survey, sum.worst_day),
                     limit_text(rules.limit_minutes_day, "min on a day", sum.over_day));
}

std::string rules_text(const FlickerRules& rules) {
  const std::string reach = rules.blade_width ? fmt::format("{:g} m", kReachOfBlade * *rules.blade_width)
                                              : fmt::format("{:g} rotor diameters", rules.reach_diameters);
  return fmt::format("every minute of {} with the sun {:g}° high or higher; shadows reach {}", rules.year.year,
                     rules.least_elevation_deg, reach);
}

std::string place_text(const DwellingsSurvey& survey, const Dwelling& dwelling) {
  const std::string at = fmt::format("{:.0f}, {:.0f}; ground {:.1f} m", dwelling.position.x, dwelling.position.y,
                                     dwelling.facades.front().ground_m);
  if (dwelling.theme == 0) return at + "; a place in the open";
  return fmt::format("{}; a building of the theme {}{}", at,
                     survey.metadata.themes[dwelling.theme - std::size_t{1}].name,
                     dwelling.id.empty() ? "" : ", id " + dwelling.id);
}

Facts facts_of_dwelling(const DwellingsSurvey& survey, const Dwelling& dwelling) {
  const DwellingsRequest& request = survey.request;
  const Turbine& nearest = request.turbines.turbines[dwelling.nearest];
  const FlickerSum sum = flicker_sum(survey, dwelling);
  Facts facts{{"Place", place_text(survey, dwelling)},
              {"Eyes", fmt::format("{:g} m above the ground{}", request.eye_height,
                                   dwelling.theme == 0 ? "" : ", before each facade")},
              {"Nearest turbine", fmt::format("{}, {:.0f} m away", name_of_turbine(nearest), dwelling.nearest_m)},
              {"Seen over bare ground", view_text(view_of(survey, dwelling, SightSurface::kBare))}};
  const DwellingFacade& any = dwelling.facades.front();
  if (!any.screened.empty())
    facts.emplace_back("Seen past what stands", view_text(view_of(survey, dwelling, SightSurface::kScreened)));
  for (const auto& [name, season] : {std::pair("Seen through woods, summer", SightSurface::kSummer),
                                     std::pair("Seen through woods, winter", SightSurface::kWinter)})
    if (!any.winter.empty()) facts.emplace_back(name, view_text(view_of(survey, dwelling, season)));
  facts.emplace_back("Shadow flicker, worst", flicker_text(survey, sum));
  if (sum.likely) facts.emplace_back("Shadow flicker, likely", fmt::format("{:.2f} h", *sum.likely / 60));
  facts.emplace_back("Sun", rules_text(request.flicker));
  facts.emplace_back("Surface", statement_of(survey.metadata, request.themes, Detail::tolerance(0)));
  facts.emplace_back("Earth", request.earth.convention());
  return facts;
}

/// What a table tells of views, of which it has room for two with their bearings.
std::vector<std::string> columns_of_view(std::size_t views) {
  std::vector<std::string> columns{"Hubs", "Tips", "Extent", "Height"};
  if (views <= 2) columns.emplace_back("From, to");
  return columns;
}

std::vector<std::string> cells_of_view(const std::optional<SightSummary>& view, std::size_t columns) {
  const bool arc = view && view->arc;
  std::vector<std::string> cells{
      view ? hubs_text(*view) : "–", view ? tips_text(*view) : "–",
      arc ? fmt::format("{:.1f}°", view->arc->width) : "–", arc ? fmt::format("{:.2f}°", view->vertical_deg) : "–",
      arc ? fmt::format("{:.0f}°, {:.0f}°", view->arc->from, bearing_behind(*view->arc)) : "–"};
  cells.resize(columns);
  return cells;
}

const char* name_of_view(SightSurface surface) {
  if (surface == SightSurface::kBare) return "over the bare ground";
  return surface == SightSurface::kScreened ? "past what stands on it" : "through woods in winter";
}

/// The views that a table of facades has room for.
std::vector<SightSurface> views_in_table(const DwellingFacade& facade) {
  std::vector<SightSurface> views{SightSurface::kBare};
  if (!facade.screened.empty()) views.push_back(SightSurface::kScreened);
  if (!facade.winter.empty()) views.push_back(SightSurface::kWinter);
  return views;
}

profile::SheetTable table_of_facades(const DwellingsSurvey& survey, const Dwelling& dwelling) {
  profile::SheetTable table{
      .title = "What each facade sees of the turbines before it (?: undecided across ground without data)",
      .first_column = 0.06};
  const std::vector<SightSurface> surfaces = views_in_table(dwelling.facades.front());
  const std::vector<std::string> columns = columns_of_view(surfaces.size());
  table.headings = {{"", 4}};
  for (const SightSurface surface : surfaces) table.headings.push_back({name_of_view(surface), columns.size()});
  table.rows = {{"Facade", "Looks to", "Length", "Turbines"}};
  for (std::size_t s = 0; s < surfaces.size(); ++s)
    table.rows[0].insert(table.rows[0].end(), columns.begin(), columns.end());
  for (const DwellingFacade& facade : dwelling.facades) {
    const auto bare = view_of(survey, facade, SightSurface::kBare);
    std::vector<std::string> row{fmt::format("{}", table.rows.size()),
                                 facade.outward_deg ? fmt::format("{:.0f}°", *facade.outward_deg) : "all round",
                                 facade.outward_deg ? fmt::format("{:.1f} m", facade.length_m) : "",
                                 fmt::format("{}", bare ? bare->turbines : 0)};
    for (const SightSurface surface : surfaces) {
      const auto cells = cells_of_view(view_of(survey, facade, surface), columns.size());
      row.insert(row.end(), cells.begin(), cells.end());
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

profile::SheetTable table_of_flicker(const DwellingsSurvey& survey, const Dwelling& dwelling) {
  profile::SheetTable table{.title = "Shadow flicker by turbine, worst case", .first_column = 0.2};
  table.rows = {{"Turbine", "Distance", "Bearing", "Hours", "Days", "Worst day", "Minutes", "Likely hours"}};
  const bool likely = survey.request.flicker.months.has_value();
  if (!likely) table.rows[0].pop_back();
  const auto add = [&](const std::string& name, const std::string& distance, const std::string& bearing,
                       const FlickerSum& sum) {
    table.rows.push_back({name, distance, bearing, fmt::format("{:.2f}", sum.hours()), fmt::format("{}", sum.days),
                          sum.days > 0 ? date_on_sheet(survey, sum.worst_day) : "",
                          fmt::format("{}", sum.worst_minutes)});
    if (likely) table.rows.back().push_back(fmt::format("{:.2f}", *sum.likely / 60));
  };
  for (const ColouredTurbine& coloured : coloured_turbines(dwelling)) {
    const Turbine& turbine = survey.request.turbines.turbines[coloured.turbine];
    const TurbineSight& sight = dwelling.facades.front().bare[coloured.turbine];
    add(name_of_turbine(turbine), fmt::format("{:.0f} m", sight.distance), fmt::format("{:.1f}°", sight.azimuth),
        flicker_sum(survey, dwelling, coloured.turbine));
  }
  add("all together", "", "", flicker_sum(survey, dwelling));
  return table;
}

profile::MapSheet map_about(const SheetOfSurvey& of, const Dwelling& dwelling, profile::PaperSize paper,
                            Progress& progress) {
  profile::MapSheet map;
  map.paper = paper, map.scale = of.choice.scale, map.crs_wkt = of.survey.metadata.crs_wkt;
  map.area = area_about(of.survey, dwelling);
  map.scale = profile::scale_of_dwelling_map(map);
  const Box ground = profile::ground_in_dwelling_map(map);
  const MapBase base = map_base(of.store, ground, map.scale, of.choice.basemap, progress);
  map.layers = {base.picture};
  map.layers.insert(map.layers.end(), base.contours.begin(), base.contours.end());
  for (MapObjects& objects : objects_about(of.survey, dwelling, ground)) {
    map.layers.insert(map.layers.end(), objects.layers.begin(), objects.layers.end());
    map.legend.insert(map.legend.end(), objects.keys.begin(), objects.keys.end());
  }
  map.legend.insert(map.legend.end(), base.keys.begin(), base.keys.end());
  map.title.project = of.choice.project, map.title.date = of.choice.date;
  map.title.sources = described(sources_in(of.store, ground, of.survey.request.themes), of.survey.metadata);
  if (!of.choice.basemap.empty()) map.title.sources.push_back(basemap_fact(of.choice.basemap).second);
  return map;
}

}  // namespace

std::string sheet_title(const DwellingsSurvey& survey, std::size_t dwelling) {
  const std::string& name = name_of_dwelling(survey.dwellings[dwelling]);
  return fmt::format("Dwelling {}{}{}", dwelling + 1, name.empty() ? "" : ": ", name);
}

profile::DwellingSheet dwelling_sheet(const SheetOfSurvey& of, std::size_t number, profile::PaperSize paper,
                                      Progress& progress) {
  const Dwelling& dwelling = of.survey.dwellings[number];
  return {sheet_title(of.survey, number),
          facts_of_dwelling(of.survey, dwelling),
          table_of_facades(of.survey, dwelling),
          table_of_flicker(of.survey, dwelling),
          of.calendars.of(dwelling),
          map_about(of, dwelling, paper, progress),
          plan_of(dwelling, paper)};
}

}  // namespace itin::viewshed
