// What dwellings see of wind farms, and shadow flicker there.
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <itin/error.hpp>
#include <viewshed/dwellings.hpp>

#include "arguments.hpp"
#include "arrays.hpp"
#include "call.hpp"
#include "module.hpp"
#include "shared_store.hpp"
#include "turbines.hpp"

namespace itin::python {

namespace {

using viewshed::SightSurface;

struct Survey {
  SharedStore store;
  viewshed::DwellingsSurvey survey;

  /// The number by which tables call a turbine.
  std::size_t number_of(std::size_t turbine) const { return survey.request.turbines.turbines[turbine].number; }
};

/// Reads `dwellings`: a list of places as dictionaries, or the path of a file; nothing: all buildings.
viewshed::SitePlaces dwellings_of(const py::dict& fields, const Store& store) {
  viewshed::SitePlaces places;
  if (!fields.contains("dwellings")) return places;
  const py::object given = fields["dwellings"];
  if (py::isinstance<py::str>(given)) {
    std::string crs;
    take(fields, "turbine_crs", crs);
    return viewshed::read_dwellings(given.cast<std::string>(), crs, store.metadata().crs_wkt);
  }
  places.source = "dwellings";
  for (const py::handle one : given) {
    const auto place = one.cast<py::dict>();
    viewshed::SitePlace& dwelling = places.places.emplace_back();
    take(place, "name", dwelling.name);
    take(place, "x", dwelling.position.x), take(place, "y", dwelling.position.y);
  }
  return places;
}

/// Reads `months`: the path of a table, or the shares of sunshine and operation of twelve months.
std::optional<std::array<viewshed::MonthShare, 12>> months_of(const py::dict& fields) {
  if (!fields.contains("months")) return std::nullopt;
  const py::object given = fields["months"];
  if (py::isinstance<py::str>(given)) return viewshed::read_months(given.cast<std::string>());
  const auto pairs = given.cast<std::vector<std::pair<double, double>>>();
  std::array<viewshed::MonthShare, 12> months;
  if (pairs.size() != months.size()) throw InputError("`months`: give 12 pairs of sunshine and operation", "months");
  for (std::size_t i = 0; i < months.size(); ++i) months[i] = {pairs[i].first, pairs[i].second};
  return months;
}

viewshed::FlickerRules flicker_rules_of(const py::dict& fields) {
  viewshed::FlickerRules rules;
  take(fields, "year", rules.year.year), take(fields, "utc_offset_minutes", rules.year.utc_offset_minutes);
  take(fields, "least_elevation_deg", rules.least_elevation_deg);
  take(fields, "reach_diameters", rules.reach_diameters);
  take(fields, "blade_width", rules.blade_width);
  take(fields, "limit_minutes_year", rules.limit_minutes_year);
  take(fields, "limit_minutes_day", rules.limit_minutes_day);
  rules.months = months_of(fields);
  return rules;
}

viewshed::DwellingsRequest dwellings_request_of(const py::dict& fields, const Store& store) {
  viewshed::DwellingsRequest request;
  request.turbines = turbines_of(fields, store.metadata().crs_wkt);
  request.dwellings = dwellings_of(fields, store);
  take(fields, "dwelling_theme", request.dwelling_theme);
  take(fields, "radius", request.radius);
  take(fields, "eye_height", request.eye_height);
  request.flicker = flicker_rules_of(fields);
  request.earth = earth_of(fields, store.metadata().crs_wkt);
  request.themes = themes_of(fields);
  request.nodata = nodata_of(fields);
  if (const auto foliage = foliage_of(fields)) request.foliage = {foliage->extinction, foliage->least_transmittance};
  take(fields, "memory_bytes", request.memory_bytes);
  return request;
}

std::shared_ptr<Survey> survey_of(const SharedStore& store, const py::dict& fields, const py::object& show) {
  viewshed::DwellingsRequest request = dwellings_request_of(fields, *store);
  const LeftOut left_out(fields);
  auto survey = result_of(show, [&](Progress& progress) {
    left_out.leave(*store, request.themes, progress);
    return survey_dwellings(*store, std::move(request), progress);
  });
  return std::make_shared<Survey>(Survey{store, std::move(survey)});
}

/// Returns what a facade or a dwelling sees over a surface: turbines before it, tips and hubs, those undecided, the
/// nearest turbine, the arc and the vertical angle; None where nothing was looked at.
template <class Looker>
py::object view_by(const Survey& s, const Looker& looker, SightSurface surface) {
  const auto view = viewshed::view_of(s.survey, looker, surface);
  if (!view) return py::none();
  std::optional<std::size_t> nearest;
  if (view->nearest_seen) nearest = s.number_of(*view->nearest_seen);
  std::optional<std::pair<double, double>> arc;
  if (view->arc) arc = {view->arc->from, view->arc->width};
  return py::make_tuple(view->turbines, view->tips, view->hubs, view->tips_undecided, view->hubs_undecided, nearest,
                        arc, view->vertical_deg);
}

template <class Looker>
py::tuple views_by(const Survey& s, const Looker& looker) {
  const auto over = [&](SightSurface surface) { return view_by(s, looker, surface); };
  return py::make_tuple(over(SightSurface::kBare), over(SightSurface::kScreened), over(SightSurface::kSummer),
                        over(SightSurface::kWinter));
}

py::tuple flicker_by(const Survey& s, const viewshed::Dwelling& dwelling) {
  const viewshed::FlickerSum sum = viewshed::flicker_sum(s.survey, dwelling);
  return py::make_tuple(sum.minutes, sum.days, sum.worst_day, sum.worst_minutes, sum.likely, sum.over_year,
                        sum.over_day);
}

/// Returns the runs of minutes with flicker, turbine by turbine: its number, the first minute and how many, (n, 3).
py::array calendar_of(const Survey& s, const viewshed::Dwelling& dwelling) {
  std::vector<std::uint32_t> rows;
  for (std::size_t t = 0; t < s.survey.request.turbines.turbines.size(); ++t)
    for (const viewshed::FlickerRun& run : viewshed::flicker_runs(dwelling, t))
      rows.insert(rows.end(), {static_cast<std::uint32_t>(s.number_of(t)), run.first, run.minutes});
  const auto count = static_cast<py::ssize_t>(rows.size() / 3);
  return array_of(std::move(rows), {count, 3});
}

py::list facades_of(const Survey& s, const viewshed::Dwelling& dwelling) {
  py::list facades;
  for (const viewshed::DwellingFacade& facade : dwelling.facades)
    facades.append(py::make_tuple(facade.position.x, facade.position.y, facade.ground_m, facade.outward_deg,
                                  facade.length_m, views_by(s, facade)));
  return facades;
}

py::list dwelling_list(const Survey& s) {
  py::list dwellings;
  for (const viewshed::Dwelling& d : s.survey.dwellings)
    dwellings.append(py::make_tuple(d.name, d.id, d.position.x, d.position.y, s.number_of(d.nearest), d.nearest_m,
                                    views_by(s, d), flicker_by(s, d), calendar_of(s, d), facades_of(s, d)));
  return dwellings;
}

profile::SheetChoice sheets_of(const py::dict& fields) {
  profile::SheetChoice sheets;
  std::vector<std::string> papers;
  take(fields, "sheets", papers);
  for (const std::string& paper : papers)
    sheets.papers.push_back(choice_of(paper, {"A3", "A1"}, "sheets") == 0 ? profile::PaperSize::kA3
                                                                          : profile::PaperSize::kA1);
  take(fields, "scale", sheets.scale), take(fields, "basemap", sheets.basemap);
  take(fields, "project", sheets.project), take(fields, "date", sheets.date);
  return sheets;
}

py::list write_survey(const Survey& s, const std::string& folder, const py::dict& fields, const py::object& show) {
  viewshed::DwellingsFileOptions options;
  take(fields, "overwrite", options.overwrite);
  take(fields, "sheets_of", options.sheets_of);
  options.sheets = sheets_of(fields);
  const auto written = result_of(
      show, [&](Progress& progress) { return write_dwellings(folder, *s.store, s.survey, options, progress); });
  py::list files;
  for (const viewshed::PlanFile& file : written) files.append(py::make_tuple(file.path, file.what));
  return files;
}

}  // namespace

void bind_dwellings(py::module_& module) {
  py::class_<Survey, std::shared_ptr<Survey>>(module, "Dwellings")
      .def_property_readonly("dwellings", &dwelling_list)
      .def_property_readonly("crs_wkt", [](const Survey& s) { return s.survey.metadata.crs_wkt; })
      .def_property_readonly("warnings", [](const Survey& s) { return s.survey.warnings; })
      .def_property_readonly("json", [](const Survey& s) { return json_of(s.survey); })
      .def("write", &write_survey);
  store_class(module).def("dwellings", &survey_of);
}

}  // namespace itin::python
