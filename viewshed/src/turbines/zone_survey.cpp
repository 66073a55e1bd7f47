#include "turbines/zone_survey.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>
#include <utility>

#include <itin/grid_units.hpp>
#include <itin/parallel.hpp>
#include <itin/same_place.hpp>

#include "line/infinity.hpp"
#include "turbines/proposal.hpp"
#include "turbines/zone_request.hpp"

namespace itin::viewshed {

/// Holds what is known of a tile's cells so far.
struct ZoneSurvey::TileSightings {
  TileSightings(const ExactScene& surface, std::size_t number, std::size_t words)
      : place(surface.begin(number)),
        tile(place->tile),
        centres(place->centres),
        ground(place->ground),
        seen(words),
        hubs_seen(words) {
    hubs.fill(kCountOutside), tips.fill(kCountOutside);
    open_hubs.fill(0), open_tips.fill(0);
    height.fill(0), angle.fill(0), angle_sum.fill(0);
    nearest.fill(kInfinity);
    open.fill(true);
    for (auto* sets : {&seen, &hubs_seen})
      for (auto& word : *sets) word.fill(0);
  }
  const std::unique_ptr<ExactScene::TileCells> place;  ///< its targets are the eyes, as seen from the current turbine
  const Tile& tile;
  const TileCentres& centres;
  const TileValues<double>& ground;  ///< grid units
  TileValues<double> eyes;           ///< elevations, grid units
  TileValues<std::uint16_t> hubs, tips;
  TileValues<std::uint16_t> open_hubs, open_tips;  ///< counts of those in the shadow of voids
  TileValues<double> height, angle, angle_sum, nearest;
  std::vector<TileValues<std::uint32_t>> seen, hubs_seen;
  TileValues<bool> open;     ///< whether the line to the current turbine is open
  std::vector<double> sums;  ///< one per turbine
  std::uint64_t lines = 0;
};

ZoneSurvey::ZoneSurvey(const ExactScene& ground, const Zone& zone) : ground_(ground), zone_(zone) {
  const Grid& units = ground.units();
  const double per_metre = 1 / units.resolution;
  for (std::size_t k = 0; k < zone.request.turbines.size(); ++k) {
    const Turbine& t = zone.request.turbines[k];
    Axis& axis = axes_.emplace_back();
    axis.x = easting_in_units(units, t.position.x), axis.y = northing_in_units(units, t.position.y);
    axis.base = zone.ground_m[k] * per_metre;
    axis.tip = (zone.ground_m[k] + t.tip_height) * per_metre;
    axis.hub = t.hub_height ? (zone.ground_m[k] + *t.hub_height) * per_metre : -kInfinity;
    axis.position = t.position;
    axis.radius_squared = t.radius * t.radius;
  }
  if (has_proposal(zone.request)) proposed_ = turbines_of_study_area(zone.request);
}

std::uint64_t ZoneSurvey::run(const Screen& screen, std::span<const std::size_t> tiles, Visibility& result,
                              Stage& stage) const {
  const Views views = views_over(screen.sweep);
  std::atomic<std::uint64_t> lines = 0;
  std::vector<std::vector<double>> sums(tiles.size());
  stage.for_each(tiles.size(), [&](std::size_t i) {
    lines += decide(tiles[i], screen, views, result, sums[i]);
    return std::size_t{1};
  });
  if (!zone_.request.weights.empty()) add_sums(sums, result);
  return lines;
}

/// Adds the tiles' sums. The values are rounded so that sums are exact: the result then does not depend on the order,
/// and so not on the division into parts.
void ZoneSurvey::add_sums(const std::vector<std::vector<double>>& of_tiles, Visibility& result) const {
  double tallest = 0;
  for (const Turbine& t : zone_.request.turbines) tallest = std::max(tallest, t.tip_height);
  const double most = tallest * std::accumulate(zone_.request.weights.begin(), zone_.request.weights.end(), 1.0) + 1;
  const double unit = std::exp2(std::ilogb(most) - 50);
  for (const std::vector<double>& sums : of_tiles)
    for (std::size_t k = 0; k < sums.size(); ++k) result.height_sums_m[k] += std::nearbyint(sums[k] / unit) * unit;
}

ZoneSurvey::Views ZoneSurvey::views_over(const RadialSweep& sweep) const {
  Views views(axes_.size());
  parallel_for(views.size(), [&](std::size_t k) {
    const Axis& axis = axes_[k];
    // The reach is one unit wider than the radius, since the exact test of cells against the radius is in metres.
    const double reach = zone_.request.turbines[k].radius / ground_.units().resolution + 1;
    views[k].emplace(sweep.view_of({axis.x, axis.y, axis.base, axis.tip, reach}));
  });
  return views;
}

std::uint64_t ZoneSurvey::decide(std::size_t tile, const Screen& screen, const Views& views, Visibility& result,
                                 std::vector<double>& sums) const {
  const Tile place = tile_at(zone_.grid, ground_.tiles(), tile);
  std::vector<std::size_t> near;
  for (std::size_t k = 0; k < axes_.size(); ++k)
    if (in_reach(axes_[k], place)) near.push_back(k);
  if (near.empty()) return 0;
  const auto work = std::make_unique<TileSightings>(ground_, tile, zone_.words);
  const double eye_height = zone_.request.observer_height / ground_.units().resolution;
  for (std::size_t i = 0; i < work->ground.size(); ++i) work->eyes[i] = work->ground[i] + eye_height;
  work->place->targets = work->eyes;
  if (!zone_.request.weights.empty()) work->sums.resize(axes_.size());
  for (const std::size_t k : near) {
    if (screen.open_alone) take_open_lines(k, result, *work);
    observe(k, screen, *views[k], *work);
  }
  store(*work, result);
  sums = std::move(work->sums);
  return work->lines;
}

/// Keeps only the eyes whose lines to the turbine are open.
void ZoneSurvey::take_open_lines(std::size_t turbine, const Visibility& open, TileSightings& work) const {
  const RasterBit bit = turbine_bit(zone_.request.turbines[turbine].number);
  const std::uint32_t* const bits = open.turbines.data() + bit.grid * zone_.grid.cell_count();
  for_each_cell(work.tile, [&](std::size_t cell, RasterGrid::Cell place) {
    work.open[cell] = (bits[zone_.grid.index(place)] & bit.mask) != 0;
    work.place->targets[cell] = work.open[cell] ? work.eyes[cell] : std::numeric_limits<double>::quiet_NaN();
  });
}

/// Tells whether the centre of one of the tile's cells may lie within the radius.
bool ZoneSurvey::in_reach(const Axis& axis, const Tile& tile) const {
  return squared_distance(axis.position, box_of_centres(zone_.grid, tile)) <= axis.radius_squared;
}

/// Tells whether a cell in reach of a turbine is in reach of one of the study area.
bool ZoneSurvey::in_study_area(RasterGrid::Cell place) const {
  return proposed_.empty() || std::any_of(proposed_.begin(), proposed_.end(),
                                          [&](const Turbine& t) { return viewshed::in_reach(t, zone_.grid, place); });
}

void ZoneSurvey::observe(std::size_t turbine, const Screen& screen, const RadialSweep::View& view,
                         TileSightings& work) const {
  const Axis& axis = axes_[turbine];
  screen.sweep.run(view, {work.tile, work.centres, work.place->targets}, work.place->scratch, work.place->seen);
  for_each_cell(work.tile, [&](std::size_t cell, RasterGrid::Cell place) {
    const double squared = squared_distance(zone_.request.turbines[turbine], zone_.grid, place);
    if (squared > axis.radius_squared || std::isnan(work.ground[cell])) return;
    if (work.tips[cell] == kCountOutside) work.tips[cell] = work.hubs[cell] = 0;
    const double least = work.open[cell] ? work.place->seen[cell] : std::numeric_limits<double>::quiet_NaN();
    const bool beneath = std::isinf(least);  // at the turbine's own place
    work.lines += beneath ? 0 : 1;
    if (std::isnan(least)) return;
    const Point2 eye = work.centres.at(cell);
    if (const auto& shadow = screen.shadows[turbine]; shadow && shadow->holds(eye.x, eye.y)) {
      ++work.open_tips[cell];
      if (least <= axis.hub) ++work.open_hubs[cell];
      return;
    }
    if (!work.sums.empty())
      work.sums[turbine] += zone_.request.weights[zone_.grid.index(place)] *
                            (axis.tip - (beneath ? axis.base : least)) * ground_.units().resolution;
    record(turbine, cell, beneath ? 0 : std::sqrt(squared), beneath ? axis.base : least, work);
  });
}

/// Records that the turbine is seen from the cell, down to `least` grid units of elevation.
void ZoneSurvey::record(std::size_t turbine, std::size_t cell, double distance, double least,
                        TileSightings& work) const {
  const Axis& axis = axes_[turbine];
  const double resolution = ground_.units().resolution;
  const RasterBit bit = turbine_bit(zone_.request.turbines[turbine].number);
  ++work.tips[cell];
  work.seen[bit.grid][cell] |= bit.mask;
  if (least <= axis.hub) {
    ++work.hubs[cell];
    work.hubs_seen[bit.grid][cell] |= bit.mask;
  }
  const double eye = work.ground[cell] * resolution + zone_.request.observer_height;
  const double angle =
      vertical_angle_deg(zone_.request.earth, distance, eye, least * resolution, axis.tip * resolution);
  work.height[cell] = std::max(work.height[cell], (axis.tip - least) * resolution);
  work.angle[cell] = std::max(work.angle[cell], angle);
  work.angle_sum[cell] += angle;
  work.nearest[cell] = std::min(work.nearest[cell], distance);
}

void ZoneSurvey::store(const TileSightings& work, Visibility& result) const {
  std::vector<Arc> arcs;
  for_each_cell(work.tile, [&](std::size_t from, RasterGrid::Cell place) {
    if (work.tips[from] == kCountOutside) return;
    if (!in_study_area(place)) return;
    const std::size_t to = zone_.grid.index(place);
    result.hub_count[to] = work.hubs[from];
    result.tip_count[to] = work.tips[from];
    if (zone_.leaves_open()) {
      result.hub_undecided[to] = work.open_hubs[from];
      result.tip_undecided[to] = work.open_tips[from];
    }
    for (std::size_t w = 0; w < zone_.words; ++w) {
      result.turbines[w * zone_.grid.cell_count() + to] = work.seen[w][from];
      if (!result.hubs.empty()) result.hubs[w * zone_.grid.cell_count() + to] = work.hubs_seen[w][from];
    }
    result.visible_height_m[to] = static_cast<float>(work.height[from]);
    result.vertical_angle_deg[to] = static_cast<float>(work.angle[from]);
    result.vertical_angle_sum_deg[to] = static_cast<float>(work.angle_sum[from]);
    result.share[to] = share_of_turbines(work.tips[from], zone_.request.turbines.size());
    result.horizontal_angle_deg[to] = result.horizontal_occupied_deg[to] = 0;
    if (work.tips[from] == 0) return;
    result.nearest_m[to] = static_cast<float>(work.nearest[from]);
    store_horizon(work, from, to, zone_.grid.centre(place.column, place.row), result, arcs);
  });
}

void ZoneSurvey::store_horizon(const TileSightings& work, std::size_t from_cell, std::size_t to_cell, Point2 eye,
                               Visibility& result, std::vector<Arc>& arcs) const {
  arcs.clear();
  for (const Turbine& t : zone_.request.turbines) {
    const RasterBit bit = turbine_bit(t.number);
    if ((work.seen[bit.grid][from_cell] & bit.mask) == 0) continue;
    const Point2 towards = same_place(ground_.units(), eye, t.position) ? eye : t.position;
    arcs.push_back(rotor_arc(eye, towards, t.rotor_diameter.value_or(0)));
  }
  const RotorHorizon horizon = rotor_horizon(arcs);
  result.horizontal_angle_deg[to_cell] = static_cast<float>(horizon.held.width);
  result.horizontal_from_deg[to_cell] = static_cast<float>(horizon.held.from);
  result.horizontal_occupied_deg[to_cell] = static_cast<float>(horizon.occupied);
}

}  // namespace itin::viewshed
