#include "site/visible_heights.hpp"

#include <cmath>

#include <itin/call_progress.hpp>
#include <itin/cross_section.hpp>
#include <viewshed/turbines.hpp>

#include "options/memory_option.hpp"
#include "ztv/ztv_sights.hpp"

namespace itin::cli {

namespace {

double weight_of(const viewshed::Demand& demand, std::size_t element) {
  const auto block = static_cast<std::uint32_t>(element / 64);
  return demand.in_metric(demand.weight(block, std::uint64_t{1} << (element % 64)));
}

/// The options as turbines.
viewshed::ZoneRequest zone_request(const SiteOptions& options, const SiteInputs& inputs) {
  viewshed::ZoneRequest request;
  for (std::size_t i = 0; i < inputs.options.size(); ++i)
    request.turbines.push_back({.number = i + 1,
                                .name = inputs.positions[i].name,
                                .farm = {},
                                .position = inputs.positions[i].position,
                                .tip_height = options.placement.tip_height(),
                                .hub_height = options.placement.hub_height(),
                                .rotor_diameter = options.placement.rotor_diameter(),
                                .radius = options.radius});
  request.observer_height = options.target_height;
  request.earth = options.earth.earth();
  // The least is looked for of what may be seen.
  request.nodata = options.nodata.rule() == NoData::kUnknown ? NoData::kClear : options.nodata.rule();
  return request;
}

std::vector<double> heights_over_cells(const Store& store, const SiteOptions& options, const SiteInputs& inputs,
                                       Progress& progress) {
  viewshed::ZoneRequest request = zone_request(options, inputs);
  const RasterGrid& grid = *inputs.targets.grid;
  request.grid = grid;
  request.memory_bytes = options.memory_bytes;
  if (options.themes.choice().includes_raised(store.metadata().themes)) request.themes = options.themes.choice();
  request.weights.resize(grid.cell_count());
  for (std::int64_t row = 0; row < grid.rows(); ++row)
    for (std::int64_t column = 0; column < grid.columns(); ++column)
      request.weights[grid.index({column, row})] = weight_of(inputs.demand, viewshed::element_of(grid, {column, row}));
  const viewshed::Zone zone = viewshed::survey_turbines(store, request, progress);
  return zone.screened ? zone.screened->height_sums_m : zone.bare.height_sums_m;
}

std::vector<double> heights_over_points(const Store& store, const SiteOptions& options, const SiteInputs& inputs,
                                        Progress& progress) {
  const viewshed::ZoneRequest request = zone_request(options, inputs);
  const std::vector<Point2>& points = inputs.targets.points;
  const auto grounds = viewshed::ground_under(store, points, ThemeChoice::none(), progress);
  const SectionSurface surface(store, Detail::tolerance(0), options.themes.choice(),
                               section_cache_within(options.memory_bytes));
  std::vector<double> sums(inputs.options.size());
  for (std::size_t p = 0; p < points.size(); ++p) {
    progress.throw_if_cancelled();
    progress.report("sight lines of candidates", static_cast<double>(p) / static_cast<double>(points.size()));
    if (!grounds[p]) continue;
    viewshed::Zone near;
    near.request.earth = request.earth, near.request.nodata = request.nodata;
    std::vector<std::size_t> numbers;
    for (std::size_t i = 0; i < request.turbines.size(); ++i) {
      const Point2 foot = request.turbines[i].position;
      if (std::hypot(foot.x - points[p].x, foot.y - points[p].y) > options.radius) continue;
      near.request.turbines.push_back(request.turbines[i]);
      near.ground_m.push_back(inputs.positions[i].ground);
      numbers.push_back(i);
    }
    const Viewpoint eye{p, {}, points[p], options.target_height, *grounds[p]};
    const std::vector<Sight> sights = sights_to_all(surface, eye, near);
    for (std::size_t k = 0; k < numbers.size(); ++k)
      sums[numbers[k]] += weight_of(inputs.demand, p) * sights[k].visible;
  }
  return sums;
}

}  // namespace

std::vector<double> summed_visible_heights(const Store& store, const SiteOptions& options, const SiteInputs& inputs,
                                           Progress& progress) {
  return inputs.targets.grid ? heights_over_cells(store, options, inputs, progress)
                             : heights_over_points(store, options, inputs, progress);
}

OwnElements::OwnElements(std::size_t options) {
  for (std::size_t option = 0; option < options; ++option) {
    viewshed::DemandSet own;
    own.add(static_cast<std::uint32_t>(option / 64), std::uint64_t{1} << (option % 64));
    bounds_.push_back({own, own, true});
  }
}

}  // namespace itin::cli
