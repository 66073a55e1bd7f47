#include "workflows/dwellings/output/dwelling_tables.hpp"

#include <cmath>

#include <itin/calendar_day.hpp>
#include <itin/feature_style.hpp>
#include <itin/table_columns.hpp>

#include "turbines/sun_behind_rotor.hpp"
#include "workflows/dwellings/flicker_clock.hpp"
#include "workflows/dwellings/output/dwelling_classes.hpp"
#include "workflows/dwellings/output/dwelling_names.hpp"

namespace itin::viewshed {

namespace {

/// What is seen from a place over the bare ground, over the surface with the themes, and over that with woods that are
/// seen through; nothing where nothing was looked at.
struct Views {
  template <class Looker>
  Views(const DwellingsSurvey& survey, const Looker& looker)
      : bare(view_of(survey, looker, SightSurface::kBare)),
        screened(view_of(survey, looker, SightSurface::kScreened)),
        summer(view_of(survey, looker, SightSurface::kSummer)),
        winter(view_of(survey, looker, SightSurface::kWinter)) {}
  std::optional<SightSummary> bare, screened, summer, winter;
};

struct DwellingRow {
  DwellingRow(const DwellingsSurvey& of, const Dwelling& d)
      : survey(of), dwelling(d), sum(flicker_sum(of, d)), views(of, d) {}
  Point2 position() const { return dwelling.position; }

  const DwellingsSurvey& survey;
  const Dwelling& dwelling;
  FlickerSum sum;
  Views views;
};

struct FacadeRow {
  FacadeRow(const DwellingsSurvey& of, const Dwelling& d, std::size_t n)
      : survey(of), dwelling(d), facade(d.facades[n]), number(n + 1), views(of, d.facades[n]) {}
  Point2 position() const { return {facade.position.x, facade.position.y}; }

  const DwellingsSurvey& survey;
  const Dwelling& dwelling;
  const DwellingFacade& facade;
  std::size_t number;  ///< from 1
  Views views;
};

/// A dwelling and a turbine whose flicker is there.
struct FlickerRow {
  FlickerRow(const DwellingsSurvey& of, const Dwelling& d, std::size_t t)
      : survey(of), dwelling(d), turbine(of.request.turbines.turbines[t]), sum(flicker_sum(of, d, t)) {}

  const DwellingsSurvey& survey;
  const Dwelling& dwelling;
  const Turbine& turbine;
  FlickerSum sum;
};

/// A stretch of minutes with flicker.
struct RunRow {
  std::uint32_t day() const { return run.first / SunYear::kMinutesOfDay; }
  std::uint32_t minute() const { return run.first % SunYear::kMinutesOfDay; }

  const DwellingsSurvey& survey;
  const Dwelling& dwelling;
  const Turbine& turbine;
  FlickerRun run;
};

std::string date_text(const DwellingsSurvey& survey, std::uint32_t day) {
  return iso_day_text(day_of_year(survey.request.flicker.year.year, day));
}

const char* limits_word(const FlickerSum& sum) {
  if (sum.over_year) return sum.over_day ? "year and day" : "year";
  return sum.over_day ? "day" : "none";
}

template <class Row>
std::vector<TableColumn<Row>> columns_of_dwelling() {
  return {{"name", [](const Row& row) { return row.dwelling.name; }},
          {"id", [](const Row& row) { return row.dwelling.id; }}};
}

template <class Row>
void add_turbine(std::vector<TableColumn<Row>>& columns) {
  columns.emplace_back("turbine", [](const Row& row) { return row.turbine.number; });
  columns.emplace_back("turbine_name", [](const Row& row) { return row.turbine.name; });
}

template <class Row>
void add_flicker(std::vector<TableColumn<Row>>& columns) {
  const auto add = [&](const char* name, auto of, const char* number = "{}") {
    columns.emplace_back(name, of, kInAllFormats, number);
  };
  add(
      "flicker_hours", [](const Row& row) { return row.sum.hours(); }, "{:.2f}");
  add("flicker_days", [](const Row& row) { return row.sum.days; });
  add("worst_day", [](const Row& row) {
    return row.sum.days > 0 ? std::optional(date_text(row.survey, row.sum.worst_day)) : std::nullopt;
  });
  add("worst_day_minutes", [](const Row& row) { return row.sum.worst_minutes; });
  add("over_limit", [](const Row& row) { return limits_word(row.sum); });
  add(
      "likely_hours",
      [](const Row& row) { return if_any(row.sum.likely, [](double minutes) { return minutes / 60; }); }, "{:.2f}");
}

/// Adds what is seen over one of the surfaces. `ending` goes before the unit.
template <class Row>
void add_view(std::vector<TableColumn<Row>>& columns, const std::string& ending,
              std::optional<SightSummary> Views::*surface) {
  const auto add = [&](const std::string& name, auto of, const char* number = "{}") {
    columns.emplace_back(
        name, [surface, of](const Row& row) { return if_any(row.views.*surface, of); }, kInAllFormats, number);
  };
  const auto add_nearest = [&](const std::string& name, auto of, const char* number = "{}") {
    columns.emplace_back(
        name,
        [surface, of](const Row& row) {
          const auto& turbines = row.survey.request.turbines.turbines;
          const auto nearest = if_any(row.views.*surface, &SightSummary::nearest_seen);
          return if_any(nearest, [&](std::size_t turbine) { return of(turbines[turbine], row); });
        },
        kInAllFormats, number);
  };
  add("hubs_visible" + ending, &SightSummary::hubs);
  add("tips_visible" + ending, &SightSummary::tips);
  add("hubs_undecided" + ending, &SightSummary::hubs_undecided);
  add("tips_undecided" + ending, &SightSummary::tips_undecided);
  add_nearest("nearest_visible_turbine" + ending, [](const Turbine& nearest, const Row&) { return nearest.number; });
  add_nearest(
      "nearest_visible" + ending + "_m",
      [](const Turbine& nearest, const Row& row) { return distance(nearest.position, row.position()); }, "{:.1f}");
  add(
      "horizontal_from" + ending + "_deg", [](const SightSummary& view) { return if_any(view.arc, &Arc::from); },
      "{:.2f}");
  add(
      "horizontal_extent" + ending + "_deg", [](const SightSummary& view) { return if_any(view.arc, &Arc::width); },
      "{:.2f}");
  add("vertical_angle" + ending + "_deg", &SightSummary::vertical_deg, "{:.3f}");
}

template <class Row>
void add_views(const DwellingsSurvey& survey, std::vector<TableColumn<Row>>& columns) {
  add_view(columns, "", &Views::bare);
  add_view(columns, "_screened", &Views::screened);
  if (!survey.request.foliage) return;
  add_view(columns, "_summer", &Views::summer);
  add_view(columns, "_winter", &Views::winter);
}

std::vector<TableColumn<DwellingRow>> dwelling_columns(const DwellingsSurvey& survey) {
  auto columns = columns_of_dwelling<DwellingRow>();
  const auto add = [&](const char* name, auto of, int formats = kInAllFormats, const char* number = "{}") {
    columns.emplace_back(name, of, formats, number);
  };
  add("theme", [](const DwellingRow& row) {
    const std::uint16_t theme = row.dwelling.theme;
    return theme == 0 ? std::string() : row.survey.metadata.themes[theme - std::size_t{1}].name;
  });
  add(
      "x", [](const DwellingRow& row) { return row.position().x; }, kInCsv, "{:.3f}");
  add(
      "y", [](const DwellingRow& row) { return row.position().y; }, kInCsv, "{:.3f}");
  add("facades",
      [](const DwellingRow& row) { return row.dwelling.theme == 0 ? std::size_t{0} : row.dwelling.facades.size(); });
  const auto nearest = [](const DwellingRow& row) -> const Turbine& {
    return row.survey.request.turbines.turbines[row.dwelling.nearest];
  };
  add("nearest_turbine", [nearest](const DwellingRow& row) { return nearest(row).number; });
  add("nearest_name", [nearest](const DwellingRow& row) { return nearest(row).name; });
  add(
      "nearest_m", [](const DwellingRow& row) { return row.dwelling.nearest_m; }, kInAllFormats, "{:.3f}");
  add(
      "flicker", [](const DwellingRow& row) { return std::string(class_of(class_of(row.sum)).name); }, kInLayer);
  add_flicker(columns);
  add_views(survey, columns);
  return columns;
}

std::vector<TableColumn<FacadeRow>> facade_columns(const DwellingsSurvey& survey) {
  auto columns = columns_of_dwelling<FacadeRow>();
  const auto add = [&](const char* name, auto of, int formats = kInAllFormats, const char* number = "{}") {
    columns.emplace_back(name, of, formats, number);
  };
  add("facade", [](const FacadeRow& row) { return row.number; });
  add(
      "x", [](const FacadeRow& row) { return row.facade.position.x; }, kInCsv, "{:.3f}");
  add(
      "y", [](const FacadeRow& row) { return row.facade.position.y; }, kInCsv, "{:.3f}");
  add(
      "ground_m", [](const FacadeRow& row) { return row.facade.ground_m; }, kInCsv, "{:.3f}");
  add(
      "outward_grid_deg", [](const FacadeRow& row) { return row.facade.outward_deg; }, kInAllFormats, "{:.1f}");
  add(
      "length_m", [](const FacadeRow& row) { return row.facade.length_m; }, kInAllFormats, "{:.1f}");
  add("turbines_before", [](const FacadeRow& row) { return row.views.bare ? row.views.bare->turbines : 0; });
  add_views(survey, columns);
  return columns;
}

std::vector<TableColumn<FlickerRow>> flicker_columns() {
  auto columns = columns_of_dwelling<FlickerRow>();
  add_turbine(columns);
  add_flicker(columns);
  return columns;
}

std::vector<TableColumn<RunRow>> calendar_columns() {
  auto columns = columns_of_dwelling<RunRow>();
  columns.emplace_back("date", [](const RunRow& row) { return date_text(row.survey, row.day()); });
  columns.emplace_back("from", [](const RunRow& row) { return clock_text(row.minute()); });
  columns.emplace_back("to", [](const RunRow& row) { return clock_text(row.minute() + row.run.minutes); });
  columns.emplace_back("minutes", [](const RunRow& row) { return row.run.minutes; });
  add_turbine(columns);
  return columns;
}

std::vector<DwellingRow> dwelling_rows(const DwellingsSurvey& survey) {
  std::vector<DwellingRow> rows;
  for (const Dwelling& dwelling : survey.dwellings) rows.emplace_back(survey, dwelling);
  return rows;
}

std::vector<FacadeRow> facade_rows(const DwellingsSurvey& survey) {
  std::vector<FacadeRow> rows;
  for (const Dwelling& dwelling : survey.dwellings)
    for (std::size_t f = 0; f < dwelling.facades.size(); ++f) rows.emplace_back(survey, dwelling, f);
  return rows;
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
    counts.see_a_tip_summer += sees_a_tip(SightSurface::kSummer),
        counts.see_a_tip_winter += sees_a_tip(SightSurface::kWinter);
  }
  return counts;
}

std::string dwellings_csv(const DwellingsSurvey& survey) {
  return csv_of(dwelling_columns(survey), dwelling_rows(survey));
}

std::string facades_csv(const DwellingsSurvey& survey) {
  return csv_of(facade_columns(survey), facade_rows(survey));
}

std::string flicker_csv(const DwellingsSurvey& survey) {
  std::vector<FlickerRow> rows;
  for (const Dwelling& dwelling : survey.dwellings)
    for (const std::size_t turbine : flickering_turbines(dwelling)) rows.emplace_back(survey, dwelling, turbine);
  return csv_of(flicker_columns(), rows);
}

std::string calendar_csv(const DwellingsSurvey& survey) {
  std::vector<RunRow> rows;
  for (const Dwelling& dwelling : survey.dwellings)
    for (const std::size_t turbine : flickering_turbines(dwelling))
      for (const FlickerRun& run : flicker_runs(dwelling, turbine))
        rows.push_back({survey, dwelling, survey.request.turbines.turbines[turbine], run});
  return csv_of(calendar_columns(), rows);
}

VectorLayer layer_of_dwellings(const DwellingsSurvey& survey) {
  const auto place = [](const DwellingRow& row) {
    const Point2 at = row.position();
    return std::vector<Point3>{{at.x, at.y, row.dwelling.facades.front().ground_m}};
  };
  return layer_of("dwellings", VectorLayer::Shape::kPoints, dwelling_columns(survey), dwelling_rows(survey), place,
                  point_style("flicker", kFlickerClasses));
}

VectorLayer layer_of_facades(const DwellingsSurvey& survey) {
  constexpr FeatureClass kEye{"eye", "Eye before a facade, or in the open", {105, 105, 105}};
  const auto place = [](const FacadeRow& row) {
    const Point2 at = row.position();
    return std::vector<Point3>{{at.x, at.y, row.facade.ground_m}};
  };
  return layer_of("facades", VectorLayer::Shape::kPoints, facade_columns(survey), facade_rows(survey), place,
                  point_style(kEye));
}

}  // namespace itin::viewshed
