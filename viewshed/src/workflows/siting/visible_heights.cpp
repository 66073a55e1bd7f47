#include "workflows/siting/visible_heights.hpp"

#include <itin/cross_section.hpp>
#include <itin/memory_shares.hpp>
#include <viewshed/turbine_sights.hpp>
#include <viewshed/turbines.hpp>

namespace itin::viewshed {

namespace {

double weight_of_element(const Demand& demand, std::size_t element) {
  const auto block = static_cast<std::uint32_t>(element / 64);
  return demand.in_metric(demand.weight(block, std::uint64_t{1} << (element % 64)));
}

ZoneRequest zone_of_candidates(const ShownTurbines& turbines) {
  const SitePlanRequest& call = turbines.request;
  const TurbinePlacement& placed = *call.turbines;
  ZoneRequest request;
  for (const std::size_t option : turbines.options)
    request.turbines.push_back({.number = request.turbines.size() + 1,
                                .name = turbines.inputs.positions[option].name,
                                .farm = {},
                                .position = turbines.inputs.positions[option].position,
                                .tip_height = placed.tip_height,
                                .hub_height = placed.hub_height,
                                .rotor_diameter = placed.rotor_diameter,
                                .radius = call.radius});
  request.observer_height = call.demand.height;
  request.earth = call.earth;
  request.nodata = turbines.nodata;
  return request;
}

std::vector<double> heights_over_cells(const Store& store, const ShownTurbines& turbines, Progress& progress) {
  const auto& [call, inputs, options, nodata] = turbines;
  ZoneRequest request = zone_of_candidates(turbines);
  const RasterGrid& grid = *inputs.targets.grid;
  request.grid = grid;
  request.memory_bytes = call.memory_bytes;
  if (call.themes.includes_raised(store.metadata().themes)) request.themes = call.themes;
  request.weights.resize(grid.cell_count());
  for (std::int64_t row = 0; row < grid.rows(); ++row)
    for (std::int64_t column = 0; column < grid.columns(); ++column)
      request.weights[grid.index({column, row})] = weight_of_element(inputs.demand, element_of(grid, {column, row}));
  const Zone zone = survey_turbines(store, request, progress);
  return zone.screened ? zone.screened->height_sums_m : zone.bare.height_sums_m;
}

std::vector<double> heights_over_points(const Store& store, const ShownTurbines& turbines, Progress& progress) {
  const auto& [call, inputs, options, nodata] = turbines;
  const ZoneRequest request = zone_of_candidates(turbines);
  const std::vector<Point2>& points = inputs.targets.points;
  const auto grounds = ground_under(store, points, ThemeChoice::none(), progress);
  const SectionSurface surface(store, Detail::tolerance(0), call.themes, section_cache_within(call.memory_bytes));
  std::vector<double> sums(options.size());
  for (std::size_t p = 0; p < points.size(); ++p) {
    progress.throw_if_cancelled();
    progress.report("sight lines of candidates", static_cast<double>(p) / static_cast<double>(points.size()));
    if (!grounds[p]) continue;
    Zone near;
    near.request.earth = request.earth, near.request.nodata = request.nodata;
    std::vector<std::size_t> numbers;
    for (std::size_t i = 0; i < request.turbines.size(); ++i) {
      const Point2 foot = request.turbines[i].position;
      if (distance(foot, points[p]) > call.radius) continue;
      near.request.turbines.push_back(request.turbines[i]);
      near.ground_m.push_back(inputs.positions[options[i]].ground);
      numbers.push_back(i);
    }
    const Viewpoint eye{p, {}, points[p], inputs.targets.height_of(p), *grounds[p]};
    const std::vector<TurbineSight> sights = sights_to_all(surface, eye, near);
    for (std::size_t k = 0; k < numbers.size(); ++k)
      sums[numbers[k]] += weight_of_element(inputs.demand, p) * sights[k].visible;
  }
  return sums;
}

}  // namespace

std::vector<double> summed_visible_heights(const Store& store, const ShownTurbines& turbines, Progress& progress) {
  return turbines.inputs.targets.grid ? heights_over_cells(store, turbines, progress)
                                      : heights_over_points(store, turbines, progress);
}

OwnElements::OwnElements(std::size_t options) {
  for (std::size_t option = 0; option < options; ++option) {
    DemandSet own;
    own.add(static_cast<std::uint32_t>(option / 64), std::uint64_t{1} << (option % 64));
    bounds_.push_back({own, own, true});
  }
}

}  // namespace itin::viewshed
