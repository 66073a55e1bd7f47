#include "arguments.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <itin/celestial_body.hpp>
#include <itin/error.hpp>
#include <itin/feature_at.hpp>
#include <itin/silent_progress.hpp>

namespace itin::python {

namespace {

/// Returns the rows of an array, each `columns` numbers from where it is told.
template <class Row>
std::vector<Row> finite_rows(const Numbers& array, py::ssize_t columns, const char* field,
                             Row (*row_at)(const double*)) {
  if (array.ndim() != 2 || array.shape(1) != columns)
    throw InputError(fmt::format("`{}`: give an array of shape (n, {})", field, columns), field);
  const double* const values = array.data();
  if (!std::all_of(values, values + array.size(), [](double v) { return std::isfinite(v); }))
    throw InputError(fmt::format("`{}`: holds a number that is not finite", field), field);
  std::vector<Row> rows;
  rows.reserve(static_cast<std::size_t>(array.shape(0)));
  for (py::ssize_t i = 0; i < array.shape(0); ++i) rows.push_back(row_at(values + columns * i));
  return rows;
}

/// Reads a value for both ends, or a pair. With an EIRP, a single value is that of the second end.
void take_of_ends(const py::dict& fields, const char* name, std::optional<double>& from, std::optional<double>& to) {
  if (!fields.contains(name)) return;
  const py::object given = fields[name];
  if (py::isinstance<py::sequence>(given)) {
    std::tie(from, to) = given.cast<std::pair<double, double>>();
  } else {
    to = given.cast<double>();
    if (!fields.contains("eirp_dbm")) from = to;
  }
}

/// Reads `antenna_azimuth` or `antenna_tilt`: of the first end, or a pair in which None stands for the other end.
void take_aim(const py::dict& fields, const char* name, std::optional<double>& from, std::optional<double>& to) {
  if (!fields.contains(name)) return;
  const py::object given = fields[name];
  if (py::isinstance<py::sequence>(given)) {
    std::tie(from, to) = given.cast<std::pair<std::optional<double>, std::optional<double>>>();
  } else {
    from = given.cast<double>();
  }
}

/// Reads the file of an antenna's pattern.
void take_pattern(const py::dict& fields, const char* name, profile::AimedAntenna& antenna) {
  std::string path;
  take(fields, name, path);
  if (!path.empty())
    antenna.pattern = std::make_shared<const profile::AntennaPattern>(profile::read_antenna_pattern(path));
}

}  // namespace

profile::AimedAntenna antenna_of(const py::dict& fields) {
  profile::AimedAntenna antenna;
  take_pattern(fields, "antenna", antenna);
  take(fields, "antenna_azimuth", antenna.azimuth_deg), take(fields, "antenna_tilt", antenna.tilt_deg);
  return antenna;
}

std::vector<Point2> points_of(const Numbers& array, const char* field) {
  return finite_rows<Point2>(array, 2, field, [](const double* v) { return Point2{v[0], v[1]}; });
}

std::vector<Point3> places_of(const Numbers& array, const char* field) {
  return finite_rows<Point3>(array, 3, field, [](const double* v) { return Point3{v[0], v[1], v[2]}; });
}

Detail detail_of(const py::dict& fields) {
  if (fields.contains("rings")) {
    const auto centre = fields["centre"].cast<std::pair<double, double>>();
    std::vector<Ring> rings;
    for (const auto& [radius, tolerance] : fields["rings"].cast<std::vector<std::pair<double, double>>>())
      rings.push_back({radius, tolerance});
    return Detail::rings({centre.first, centre.second}, std::move(rings));
  }
  double tolerance = 0;
  take(fields, "tolerance", tolerance);
  return Detail::tolerance(tolerance);
}

ThemeChoice themes_of(const py::dict& fields) {
  std::string themes = "all";
  take(fields, "themes", themes);
  return ThemeChoice::parse(themes);
}

void LeftOut::leave(const Store& store, ThemeChoice& themes, Progress& progress) const {
  if (names_.empty()) return;
  themes.check(store.metadata().themes);
  SilentProgress quiet(progress);
  themes = without_features(store, themes, features_called(store, names_), quiet);
}

std::optional<profile::Foliage> foliage_of(const py::dict& fields) {
  if (!fields.contains("foliage")) return std::nullopt;
  profile::Foliage foliage;
  take(fields, "foliage", foliage.extinction);
  take(fields, "transmittance", foliage.least_transmittance);
  std::string leaf_area = "on";
  take(fields, "leaf_area", leaf_area);
  foliage.set_leaf_area(leaf_area);
  return foliage;
}

Earth earth_of(const py::dict& fields, const std::string& crs_wkt) {
  Earth earth;
  std::optional<double> radius;
  if (fields.contains("earth")) {
    const auto given = fields["earth"].cast<py::tuple>();
    earth.curvature = given[0].cast<bool>();
    earth.refraction = given[1].cast<double>();
    radius = given[2].cast<std::optional<double>>();
    earth.effective_factor = given[3].cast<std::optional<double>>();
  }
  const CelestialBody body = body_of(crs_wkt);
  if (radius || !body.is_earth) earth.radius = radius.value_or(body.mean_radius_m());
  earth.validate();
  return earth;
}

NoData nodata_of(const py::dict& fields) {
  std::string rule = "unknown";
  take(fields, "nodata", rule);
  return static_cast<NoData>(choice_of(rule, {"unknown", "block", "clear"}, "nodata"));
}

Polarisation polarisation_of(const py::dict& fields) {
  std::string polarisation = "h";
  take(fields, "polarisation", polarisation);
  return static_cast<Polarisation>(choice_of(polarisation, {"h", "v"}, "polarisation"));
}

std::size_t choice_of(const std::string& text, const std::vector<std::string>& choices, const char* field) {
  const auto found = std::find(choices.begin(), choices.end(), text);
  if (found == choices.end())
    throw InputError(fmt::format("`{}` '{}': give one of {}", field, text, fmt::join(choices, ", ")), field);
  return static_cast<std::size_t>(found - choices.begin());
}

RasterGrid grid_of(const py::tuple& grid) {
  return {{grid[0].cast<double>(), grid[1].cast<double>()},
          grid[2].cast<double>(),
          grid[3].cast<double>(),
          grid[4].cast<std::int64_t>(),
          grid[5].cast<std::int64_t>()};
}

py::tuple tuple_of(const RasterGrid& grid) {
  return py::make_tuple(grid.north_west().x, grid.north_west().y, grid.cell_width(), grid.cell_height(), grid.columns(),
                        grid.rows());
}

profile::BudgetQuery budget_of(const py::dict& fields) {
  profile::BudgetQuery budget;
  take(fields, "power_dbm", budget.power_dbm), take(fields, "eirp_dbm", budget.eirp_dbm);
  take_of_ends(fields, "gain_dbi", budget.from_gain_dbi, budget.to_gain_dbi);
  take_of_ends(fields, "feeder_loss_db", budget.from_feeder_db, budget.to_feeder_db);
  take(fields, "sensitivity_dbm", budget.sensitivity_dbm), take(fields, "rain_rate_mm_h", budget.rain_rate_mm_h);
  take(fields, "geoclimatic_factor", budget.geoclimatic_factor);
  take(fields, "refractivity_gradient", budget.refractivity_gradient);
  profile::AimedAntenna &first = budget.from_antenna, &second = budget.to_antenna;
  take_pattern(fields, "from_antenna", first), take_pattern(fields, "to_antenna", second);
  take_aim(fields, "antenna_azimuth", first.azimuth_deg, second.azimuth_deg);
  take_aim(fields, "antenna_tilt", first.tilt_deg, second.tilt_deg);
  return budget;
}

}  // namespace itin::python
