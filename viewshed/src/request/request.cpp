#include "request/request.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include <itin/error.hpp>
#include <viewshed/result.hpp>

#include "request/eye.hpp"

namespace itin::viewshed {

namespace {

/// The finest step of a store's grid, metres: nothing finer is known of any ground.
constexpr double kFinestCell = 0.0001;

bool positive(double v) {
  return std::isfinite(v) && v > 0;
}

/// Checks the observer's field of view and targets, its own or the request's.
void validate_view(const Request& request, const Observer& observer) {
  const double target = observer.target_height.value_or(request.target_height);
  if (!std::isfinite(target) || (!request.target_absolute && target < 0))
    throw InputError(fmt::format("target height {:g}: give 0 or a positive number of metres", target), "target_height");
  const std::optional<double> radius = radius_of(request, observer);
  if (radius && !positive(*radius))
    throw InputError(fmt::format("radius {:g}: give a positive number of metres, or none for all the data", *radius),
                     "radius");
  const double min_radius = observer.min_radius.value_or(request.min_radius);
  if (!(std::isfinite(min_radius) && min_radius >= 0))
    throw InputError(fmt::format("least radius {:g}: give 0 or a positive number of metres", min_radius), "min_radius");
  if (radius && min_radius > *radius)
    throw InputError(fmt::format("least radius {:g} exceeds the radius {:g}", min_radius, *radius), "min_radius");
  const auto finite = [](const AngleRange& r) { return std::isfinite(r.from) && std::isfinite(r.to); };
  const auto& azimuth = observer.azimuth ? observer.azimuth : request.azimuth;
  if (azimuth && !finite(*azimuth)) throw InputError("azimuth: give two numbers of degrees", "azimuth");
  const auto& e = observer.elevation ? observer.elevation : request.elevation;
  if (e && !(finite(*e) && e->from >= -90 && e->to <= 90 && e->from <= e->to))
    throw InputError("elevation: give two numbers of degrees from -90 to 90, the lower first", "elevation");
}

void validate_observer(const Request& request, const Observer& observer) {
  if (!std::isfinite(observer.position.x) || !std::isfinite(observer.position.y))
    refuse(observer, "its position is not finite");
  if (!std::isfinite(observer.height)) refuse(observer, "its height is not a finite number");
  if (!observer.absolute && observer.height < 0) refuse(observer, "its height is below the ground; give 0 or more");
  try {
    validate_view(request, observer);
  } catch (const InputError& error) {
    // Values of the request are not the observer's fault.
    const bool own =
        observer.target_height || observer.radius || observer.min_radius || observer.azimuth || observer.elevation;
    if (!own) throw;
    refuse(observer, error.what());
  }
}

void validate_cells(const Request& request) {
  if (request.cell_size && request.grid)
    throw InputError("both a cell size and a grid are given: give one of them", "cell_size");
  if (request.cell_size && !positive(*request.cell_size))
    throw InputError(fmt::format("cell size {:g}: give a positive number of metres", *request.cell_size), "cell_size");
  if (request.cell_size && *request.cell_size < kFinestCell)
    throw InputError(fmt::format("cell size {:g}: give at least {} metres", *request.cell_size, kFinestCell),
                     "cell_size");
  const double cell =
      request.grid ? std::max(request.grid->cell_width(), request.grid->cell_height()) : request.cell_size.value_or(0);
  for (const Observer& observer : request.observers) {
    const std::optional<double> radius = radius_of(request, observer);
    if (radius && cell > *radius)
      throw InputError(
          fmt::format("cells of {:g} m are larger than the radius of {:g} m: give smaller cells", cell, *radius),
          "cell_size");
  }
}

/// The least of 1, 2, 5, 10, ... or their decimal fractions with at most kDefaultCells cells per side, and not less
/// than `finest` unless that leaves fewer than kFewestCells.
double default_cell_size(const Box& box, double finest) {
  constexpr int kFewestCells = 40;
  const double side = std::max(box.width(), box.height());
  const double least = std::max(side / kDefaultCells, std::min(finest, side / kFewestCells));
  const double decade = std::pow(10, std::floor(std::log10(least)));
  for (const double step : {1.0, 2.0, 5.0})
    if (step * decade >= least) return step * decade;
  return 10 * decade;
}

/// A GeoTIFF can have at most this many bands.
constexpr std::size_t kMostBands = 65535;

/// Every 32 observers take a band.
void validate_bands(const Request& request) {
  const std::size_t bands = request.mode == Mode::kWhich ? bit_grids(request.observers.size()) : 1;
  if (bands > kMostBands)
    throw InputError(
        fmt::format("{} observers take {} bands to tell apart, and a raster has at most {}: give at most {} observers, "
                    "or count them",
                    request.observers.size(), bands, kMostBands, 32 * kMostBands),
        "observers");
}

RasterGrid with_room_for_bands(const Request& request, RasterGrid grid) {
  const std::size_t bands = request.mode == Mode::kWhich ? bit_grids(request.observers.size()) : 1;
  const auto most = static_cast<std::size_t>(RasterGrid::kMaxCells);
  if (grid.cell_count() > most / bands)
    throw InputError(fmt::format("{} cells in {} bands, one for every 32 observers, are more than {} values: give "
                                 "larger cells or fewer observers, or count them",
                                 grid.cell_count(), bands, most),
                     "observers");
  return grid;
}

void validate_errors(const VerticalError& e) {
  if (!positive(e.sigma))
    throw InputError(fmt::format("vertical error {:g}: give a positive number of metres", e.sigma), "vertical_error");
  if (!(std::isfinite(e.correlation_length) && e.correlation_length >= 0))
    throw InputError(
        fmt::format("correlation length {:g}: give 0 or a positive number of metres", e.correlation_length),
        "vertical_error");
}

/// Requires both ends above the ground: the zone ends at both ends of a line, and on the ground nothing of it is clear.
void validate_zones(const Request& request) {
  const FresnelCriterion& zone = request.fresnel;
  if (!positive(zone.wavelength))
    throw InputError(fmt::format("wavelength {:g}: give a positive number of metres", zone.wavelength), "fresnel");
  if (!positive(zone.fraction) || zone.fraction > 1)
    throw InputError(fmt::format("fraction {:g} of the Fresnel zone: give a number above 0, 1 at most", zone.fraction),
                     "fresnel");
  for (const Observer& observer : request.observers) {
    if (!observer.absolute && observer.height == 0)
      refuse(observer, "its height is 0, and no link from the ground has a clear Fresnel zone; give more");
    if (!request.target_absolute && observer.target_height.value_or(request.target_height) == 0)
      throw InputError("no link to the ground has a clear Fresnel zone: give a `target_height` above 0",
                       "target_height");
  }
}

void validate_radio(const Request& request) {
  const RadioPath& radio = request.radio;
  if (!positive(radio.frequency_ghz))
    throw InputError(fmt::format("frequency {:g}: give a positive number of GHz", radio.frequency_ghz), "radio");
  if (!(radio.over_sea >= 0 && radio.over_sea <= 1))
    throw InputError(fmt::format("share over sea {:g}: give 0 to 1", radio.over_sea), "radio");
  if (radio.effective_earth_km != effective_earth_km(request.earth))
    throw InputError(fmt::format("the effective Earth radius of {:g} km is not that of the sight lines, {:g} km",
                                 radio.effective_earth_km, effective_earth_km(request.earth)),
                     "radio");
}

/// Whether the observer has something of an antenna of its own.
bool has_antenna(const Observer& observer) {
  return !observer.antenna.empty();
}

void validate_budgets(const Request& request) {
  const bool all = std::all_of(request.observers.begin(), request.observers.end(), has_antenna);
  if (!all) validate_budget_of_area(request.budget);
  for (const Observer& observer : request.observers) {
    if (!has_antenna(observer)) continue;
    try {
      validate_budget_of_area(budget_of(request, observer));
    } catch (const InputError& error) {
      throw InputError(fmt::format("observer '{}': {}", observer.name, error.what()), error.field());
    }
  }
}

void validate_margins(const Request& request) {
  constexpr std::size_t kMostMargins = 20;
  const std::vector<double>& margins = request.margins_db;
  if (margins.empty()) return;
  if (!request.budget.sensitivity_dbm)
    throw InputError("`margins_db`: a margin is over the sensitivity; give `sensitivity_dbm`", "margins_db");
  if (margins.size() > kMostMargins)
    throw InputError(fmt::format("{} margins: give at most {}", margins.size(), kMostMargins), "margins_db");
  for (std::size_t i = 0; i < margins.size(); ++i)
    if (!std::isfinite(margins[i]) || (i > 0 && margins[i] <= margins[i - 1]))
      throw InputError("`margins_db`: give numbers of dB, each greater than the one before", "margins_db");
}

}  // namespace

bool casts_rays(const Request& request) {
  return request.engine == Engine::kRays;
}

bool needs_triangles(const Request& request) {
  return request.mode == Mode::kBlocker || request.mode == Mode::kProbability || request.mode == Mode::kFresnel ||
         studies_paths(request);
}

bool needs_bare_lines(const Request& request) {
  return studies_paths(request);
}

bool studies_paths(const Request& request) {
  return request.mode == Mode::kLoss || request.mode == Mode::kLevel;
}

bool tells_outage(const Request& request) {
  return request.mode == Mode::kLevel && request.budget.rain_rate_mm_h && request.budget.sensitivity_dbm;
}

std::optional<double> radius_of(const Request& request, const Observer& observer) {
  return observer.radius ? observer.radius : request.radius;
}

bool all_bounded(const Request& request) {
  return std::all_of(request.observers.begin(), request.observers.end(),
                     [&](const Observer& o) { return radius_of(request, o).has_value(); });
}

void validate(const Request& request) {
  if (request.observers.empty()) throw InputError("no observer: give at least one", "observers");
  if (request.mode == Mode::kCount && request.observers.size() >= kCountOutside)
    throw InputError(
        fmt::format("{} observers are too many to count: give at most {}", request.observers.size(), kCountOutside - 1),
        "observers");
  validate_bands(request);
  for (const Observer& observer : request.observers) validate_observer(request, observer);
  validate_cells(request);
  if (request.engine == Engine::kRays && request.mode == Mode::kHeight)
    throw InputError("rays tell whether a target is seen, not from what height on: give the engine sweep or auto",
                     "engine");
  request.earth.validate();
  if (request.mode == Mode::kProbability) validate_errors(request.vertical_error);
  if (request.mode == Mode::kFresnel) validate_zones(request);
  if (studies_paths(request)) validate_radio(request);
  if (request.mode != Mode::kLevel) return;
  validate_budgets(request);
  validate_margins(request);
}

profile::AimedAntenna completed(const profile::AimedAntenna& own, const profile::AimedAntenna& of_all) {
  profile::AimedAntenna antenna = of_all;
  if (own.pattern) antenna.pattern = own.pattern;
  if (own.azimuth_deg) antenna.azimuth_deg = own.azimuth_deg;
  if (own.tilt_deg) antenna.tilt_deg = own.tilt_deg;
  return antenna;
}

profile::BudgetQuery budget_of(const Request& request, const Observer& observer) {
  profile::BudgetQuery budget = request.budget;
  budget.from_antenna = completed(observer.antenna, budget.from_antenna);
  return budget;
}

void validate_budget_of_area(const profile::BudgetQuery& budget) {
  budget.validate();
  if (!budget.asks()) throw InputError("a level depends on what is sent: give `power_dbm` or `eirp_dbm`", "power_dbm");
  for (const auto& [field, value] : {std::pair("geoclimatic_factor", &budget.geoclimatic_factor),
                                     {"refractivity_gradient", &budget.refractivity_gradient}})
    if (*value)
      throw InputError(fmt::format("`{}`: multipath is of a single link in sight, not of an area; leave it out", field),
                       field);
  const profile::AimedAntenna& antenna = budget.from_antenna;
  if (antenna.pattern && !antenna.azimuth_deg)
    throw InputError("`antenna_azimuth`: the antenna of an observer cannot aim at all cells; say where it points",
                     "antenna_azimuth");
  if (antenna.pattern && !antenna.tilt_deg)
    throw InputError(
        "`antenna_tilt`: the antenna of an observer cannot aim at all cells; say how far it is tilted, or 0",
        "antenna_tilt");
}

void validate_certified(const Request& request) {
  validate(request);
  if (request.mode != Mode::kVisible) throw InputError("certificates tell what is visible, and nothing else", "mode");
}

bool has_raised_features(const Store& store, const Request& request) {
  return request.themes.includes_raised(store.metadata().themes);
}

bool bounds_elevations(const Request& request) {
  return request.elevation || std::any_of(request.observers.begin(), request.observers.end(),
                                          [](const Observer& observer) { return observer.elevation.has_value(); });
}

RasterGrid cells_of(const Request& request, const Box& extent) {
  if (request.grid) return with_room_for_bands(request, *request.grid);
  Box area = extent;
  if (all_bounded(request)) {
    area = {};
    for (const Observer& observer : request.observers)
      area.extend(intersection(square_about(observer.position, *radius_of(request, observer)), extent));
  }
  if (area.empty()) throw InputError("no observer's radius reaches any data", "observers");
  const double size = request.cell_size ? *request.cell_size : default_cell_size(area, request.finest_default_cell);
  return with_room_for_bands(request, RasterGrid::aligned(area, size));
}

std::string nodata_text(NoData rule) {
  switch (rule) {
    case NoData::kUnknown:
      return "unknown";
    case NoData::kBlock:
      return "block";
    case NoData::kClear:
      return "clear";
  }
  return {};
}

}  // namespace itin::viewshed
