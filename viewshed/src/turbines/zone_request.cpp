#include "turbines/zone_request.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <itin/error.hpp>

#include "bounds/boundary.hpp"
#include "line/infinity.hpp"
#include "plan/memory.hpp"
#include "request/request_window.hpp"
#include "turbines/turbine_shadows.hpp"

namespace itin::viewshed {

namespace {

bool is_positive(double v) {
  return std::isfinite(v) && v > 0;
}

void require_valid_turbine(const Turbine& t) {
  const auto refuse = [&](const std::string& what) {
    throw InputError(fmt::format("turbine {} at {:.10g},{:.10g}: {}", t.number, t.position.x, t.position.y, what),
                     "turbines");
  };
  if (t.number < 1) refuse("turbines are numbered from 1");
  if (!std::isfinite(t.position.x) || !std::isfinite(t.position.y)) refuse("its position is not finite");
  if (!is_positive(t.tip_height)) refuse("its tip height is not a positive number");
  if (!is_positive(t.radius)) refuse("its radius is not a positive number");
  if (t.hub_height && !(*t.hub_height > 0 && *t.hub_height <= t.tip_height))
    refuse("its hub is not between ground and tip");
  if (t.rotor_diameter && !is_positive(*t.rotor_diameter)) refuse("its rotor's diameter is not a positive number");
}

RasterGrid grid_of(const ZoneRequest& request, const Box& coverage) {
  if (request.grid) return *request.grid;
  Box area;
  for (const Turbine& t : turbines_of_study_area(request))
    area.extend(intersection(coverage, square_about(t.position, t.radius)));
  return RasterGrid::aligned(area, *request.cell_size);
}

void place_turbines(const std::function<std::optional<double>(Point2)>& ground, Zone& zone) {
  std::vector<Turbine> placed;
  for (Turbine& t : zone.request.turbines) {
    if (const auto height = ground(t.position)) {
      zone.ground_m.push_back(*height);
      placed.push_back(std::move(t));
    } else {
      zone.misplaced.push_back(
          {t.number, fmt::format("there is no data at {:.10g},{:.10g}", t.position.x, t.position.y)});
    }
  }
  if (placed.empty())
    throw InputError(fmt::format("no turbine that can be used stands on data: turbine {}: {}; see the CRS of the "
                                 "turbines and of the store",
                                 zone.misplaced.front().number, zone.misplaced.front().message),
                     "turbines");
  zone.request.turbines = std::move(placed);
}

/// Finds out whether sight lines may cross ground without data, where such ground does not count as clear.
void find_voids_of_zone(const Tin& outline, Zone& zone) {
  const ZoneRequest& request = zone.request;
  if (request.nodata == NoData::kClear) return;
  const std::vector<RimEdge> rim = rim_of(outline, boundary_edges(outline));
  zone.shadow_bytes = bytes_of_shadows(request.turbines, zone.grid.bounds(), outline.grid, rim);
  zone.crosses_voids = zone.shadow_bytes > 0;
  if (!zone.radar) return;
  Box ends = zone.grid.bounds();
  for (const Turbine& t : request.turbines) ends.extend(t.position);
  const Point2 radar = request.radar->position;
  zone.radar->crosses_voids = surface_resumes(outline.grid, rim, radar, kInfinity, hull_about(radar, ends));
}

Visibility nothing_seen(const Zone& zone) {
  const std::size_t cells = zone.grid.cell_count();
  Visibility v;
  v.hub_count.assign(cells, kCountOutside);
  v.tip_count.assign(cells, kCountOutside);
  if (zone.leaves_open()) v.hub_undecided = v.tip_undecided = v.tip_count;
  if (!zone.request.weights.empty()) v.height_sums_m.assign(zone.request.turbines.size(), 0);
  if (zone.parts) return v;
  v.turbines.assign(cells * zone.words, 0);
  if (zone.request.foliage) v.hubs = v.turbines;
  for (std::vector<float>* floats :
       {&v.visible_height_m, &v.vertical_angle_deg, &v.vertical_angle_sum_deg, &v.horizontal_angle_deg,
        &v.horizontal_from_deg, &v.horizontal_occupied_deg, &v.share, &v.nearest_m})
    floats->assign(cells, std::numeric_limits<float>::quiet_NaN());
  return v;
}

void see_nothing(const Zone& zone, RadarView& radar) {
  radar.height_m.assign(zone.grid.cell_count(), std::numeric_limits<float>::quiet_NaN());
  radar.turbine_m.assign(zone.request.turbines.size(), 0);
  if (!radar.crosses_voids || zone.request.nodata != NoData::kUnknown) return;
  radar.undecided_height_m = radar.height_m, radar.undecided_turbine_m = radar.turbine_m;
}

}  // namespace

void validate(const ZoneRequest& request) {
  if (request.turbines.empty()) throw InputError("no turbine: give at least one", "turbines");
  if (request.turbines.size() >= kCountOutside) throw InputError("too many turbines: give at most 65534", "turbines");
  for (const Turbine& t : request.turbines) {
    require_valid_turbine(t);
    if (request.cell_size && *request.cell_size > t.radius)
      throw InputError(fmt::format("cells of {:g} m are larger than turbine {}'s radius of {:g} m", *request.cell_size,
                                   t.number, t.radius),
                       "cell_size");
  }
  if (!std::isfinite(request.observer_height) || request.observer_height < 0)
    throw InputError(
        fmt::format("observer height {:g}: give 0 or a positive number of metres", request.observer_height),
        "observer_height");
  if (request.cell_size.has_value() == request.grid.has_value())
    throw InputError("give a cell size or a grid, and not both", "cell_size");
  if (request.cell_size && !is_positive(*request.cell_size))
    throw InputError(fmt::format("cell size {:g}: give a positive number of metres", *request.cell_size), "cell_size");
  if (!request.weights.empty() && (!request.grid || request.weights.size() != request.grid->cell_count()))
    throw InputError("`weights` needs `grid` and one value for each cell", "weights");
  request.earth.validate();
}

Request view_of(const ZoneRequest& zone) {
  Request request;
  for (const Turbine& turbine : turbines_of_study_area(zone)) {
    Observer& observer = request.observers.emplace_back();
    observer.position = turbine.position;
    observer.radius = turbine.radius;
  }
  request.grid = zone.grid;
  return request;
}

Zone placed_zone(const ZoneRequest& request, const Tin& outline,
                 const std::function<std::optional<double>(Point2)>& ground, bool screens) {
  Zone zone;
  zone.request = request;
  place_turbines(ground, zone);
  zone.grid = grid_of(zone.request, outline.bounds());
  if (zone.request.radar) zone.radar.emplace();
  find_voids_of_zone(outline, zone);
  for (const Turbine& t : zone.request.turbines) zone.words = std::max(zone.words, bit_grids(t.number));
  if (screens) zone.screened.emplace();
  return zone;
}

void make_room(Zone& zone) {
  if (const auto memory = zone.request.memory_bytes)
    require_memory_for_rasters(zone.grid, bytes_of_results(zone), *memory);
  zone.bare = nothing_seen(zone);
  if (zone.radar) see_nothing(zone, *zone.radar);
  if (zone.screened) zone.screened = zone.bare;
}

std::uint64_t bytes_of_results(const Zone& zone) {
  const std::uint64_t surfaces = zone.screened ? 2 : 1, counts = zone.leaves_open() ? 8 : 4,
                      open_heights = zone.request.nodata == NoData::kUnknown && zone.radar && zone.radar->crosses_voids,
                      of_radar = zone.radar ? 4 * (1 + open_heights) : 0, sets = zone.request.foliage ? 2 : 1;
  const std::uint64_t of_parts = zone.parts ? 0 : surfaces * (32 + 4 * sets * zone.words);
  return (of_parts + surfaces * counts + of_radar) * zone.grid.cell_count();
}

std::uint64_t bytes_beside_surfaces(const Zone& zone) {
  return bytes_of_results(zone) + zone.shadow_bytes;
}

}  // namespace itin::viewshed
