#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include <itin/error.hpp>
#include <itin/triangulate.hpp>
#include <viewshed/turbines.hpp>

#include "axis_sweep.hpp"
#include "binned_heights.hpp"
#include "boundary.hpp"
#include "eye.hpp"
#include "least_height.hpp"
#include "radar_survey.hpp"
#include "request.hpp"
#include "scene.hpp"
#include "stopwatch.hpp"
#include "zone_survey.hpp"

namespace itin::viewshed {

namespace {

bool positive(double v) {
  return std::isfinite(v) && v > 0;
}

void validate(const Turbine& t) {
  const auto refuse = [&](const std::string& what) {
    throw InputError(fmt::format("turbine {} at {:.10g},{:.10g}: {}", t.number, t.position.x, t.position.y, what));
  };
  if (t.number < 1) refuse("turbines are numbered from 1");
  if (!std::isfinite(t.position.x) || !std::isfinite(t.position.y)) refuse("its position is not finite");
  if (!positive(t.tip_height)) refuse("its tip height is not a positive number");
  if (!positive(t.radius)) refuse("its radius is not a positive number");
  if (t.hub_height && !(*t.hub_height > 0 && *t.hub_height <= t.tip_height))
    refuse("its hub is not between ground and tip");
  if (t.rotor_diameter && !positive(*t.rotor_diameter)) refuse("its rotor's diameter is not a positive number");
}

void validate(const ZoneRequest& request) {
  if (request.turbines.empty()) throw InputError("no turbine: give at least one");
  if (request.turbines.size() >= kCountOutside) throw InputError("too many turbines: give at most 65534");
  for (const Turbine& t : request.turbines) {
    validate(t);
    if (request.cell_size && *request.cell_size > t.radius)
      throw InputError(fmt::format("cells of {:g} m are larger than turbine {}'s radius of {:g} m", *request.cell_size,
                                   t.number, t.radius));
  }
  if (!std::isfinite(request.observer_height) || request.observer_height < 0)
    throw InputError(
        fmt::format("observer height {:g}: give 0 or a positive number of metres", request.observer_height));
  if (request.cell_size.has_value() == request.grid.has_value())
    throw InputError("give a cell size or a grid, and not both");
  if (request.cell_size && !positive(*request.cell_size))
    throw InputError(fmt::format("cell size {:g}: give a positive number of metres", *request.cell_size));
  request.earth.validate();
}

/// Moves turbines without ground to the misplaced.
void place_turbines(const Tin& tin, const BinnedHeights& binned, Zone& zone) {
  std::vector<Turbine> placed;
  for (Turbine& t : zone.request.turbines) {
    if (const auto height = binned.ground(tin, t.position)) {
      zone.ground_m.push_back(*height);
      placed.push_back(std::move(t));
    } else {
      zone.misplaced.push_back(
          {t.number, fmt::format("there is no data at {:.10g},{:.10g}", t.position.x, t.position.y)});
    }
  }
  if (placed.empty()) throw InputError("no turbine stands on any data; see the CRS of the turbines and of the store");
  zone.request.turbines = std::move(placed);
}

/// The part of the coverage that may lie within the radius.
Box reach(const Turbine& t, const Box& coverage) {
  return {std::max(coverage.xmin, t.position.x - t.radius), std::max(coverage.ymin, t.position.y - t.radius),
          std::min(coverage.xmax, t.position.x + t.radius), std::min(coverage.ymax, t.position.y + t.radius)};
}

RasterGrid grid_of(const ZoneRequest& request, const Box& coverage) {
  if (request.grid) return *request.grid;
  Box area;
  for (const Turbine& t : request.turbines) area.extend(reach(t, coverage));
  return RasterGrid::aligned(area, *request.cell_size);
}

double ceiling(const Tin& tin, const ZoneRequest& request) {
  double highest = 0, above = request.observer_height;
  for (const GridPoint& v : tin.vertices) highest = std::max(highest, v.z * tin.grid.resolution);
  for (const Turbine& t : request.turbines) above = std::max(above, t.tip_height);
  return highest + above;
}

/// What hides besides the surface, where ground without data does.
std::optional<Scene> curtains(const Tin& tin, const ZoneRequest& request) {
  if (request.nodata != NoData::kBlock) return std::nullopt;
  return Scene(tin, request.earth, request.nodata, ceiling(tin, request));
}

void warn_of_voids(const Tin& tin, const std::vector<BoundaryEdge>& boundary, Zone& zone) {
  if (zone.request.nodata != NoData::kUnknown) return;
  const bool crossed = std::any_of(zone.request.turbines.begin(), zone.request.turbines.end(), [&](const Turbine& t) {
    return surface_resumes(tin, boundary, t.position, t.radius);
  });
  if (crossed) zone.warnings.emplace_back(kVoidsWarning);
}

RadarView radar_view(const Tin& ground, const Scene& scene, const TriangleBins& bins, const RasterGrid& tiles,
                     const LeastHeights& heights, const Zone& zone, Progress& progress) {
  const Observer& radar = *zone.request.radar;
  const auto height = scene.ground(radar.position);
  Request request;
  request.earth = zone.request.earth;
  const Eye eye = eye_of(ground.grid, request, radar, height);
  RadarView view;
  view.ground_m = *height;
  view.height_m = radar_heights(eye, ground, bins, tiles, zone.grid, heights, progress);
  for (std::size_t k = 0; k < zone.request.turbines.size(); ++k)
    view.turbine_m.push_back(radar_sees(eye, ground, zone.request.turbines[k], zone.ground_m[k], heights));
  return view;
}

/// Of one farm: a disc about its middle that holds every turbine's reach.
Window::Polygon farm_disc(const std::vector<const Turbine*>& farm) {
  Box box;
  for (const Turbine* t : farm) box.extend(t->position);
  const Point2 middle{(box.xmin + box.xmax) / 2, (box.ymin + box.ymax) / 2};
  double radius = 0;
  for (const Turbine* t : farm)
    radius = std::max(radius, std::hypot(t->position.x - middle.x, t->position.y - middle.y) + t->radius);
  return Window::disc(middle, radius).parts().front();
}

/// Convex about the radar and all the rest, so that it holds the radar's sight lines.
Window::Polygon box_about(const std::vector<Window::Polygon>& parts, Point2 radar) {
  Box box;
  box.extend(Point2{radar.x - 1, radar.y - 1});
  box.extend(Point2{radar.x + 1, radar.y + 1});
  for (const Window::Polygon& part : parts)
    for (const Point2& p : part.outer) box.extend(p);
  return {{{box.xmin, box.ymin}, {box.xmax, box.ymin}, {box.xmax, box.ymax}, {box.xmin, box.ymax}}, {}};
}

Window window_of(const ZoneRequest& request) {
  std::map<std::string, std::vector<const Turbine*>> farms;
  for (const Turbine& t : request.turbines) farms[t.farm].push_back(&t);
  std::vector<Window::Polygon> parts;
  for (const auto& [name, farm] : farms) parts.push_back(farm_disc(farm));
  if (request.radar) parts.push_back(box_about(parts, request.radar->position));
  return Window::polygons(std::move(parts));
}

/// Of the vertices that a query at this detail reads, those within the window's box, were they spread evenly.
double vertices_within(const StoreMetadata& metadata, const ZoneRequest& request, const Box& window) {
  double vertices = 0;
  for (std::size_t k = metadata.levels.size(); k-- > 0;) {
    vertices += static_cast<double>(metadata.levels[k].vertices);
    if (metadata.levels[k].tolerance <= request.detail.coarsest()) break;
  }
  const Box all = metadata.grid.box(metadata.bounds);
  const double width = std::min(all.xmax, window.xmax) - std::max(all.xmin, window.xmin);
  const double height = std::min(all.ymax, window.ymax) - std::max(all.ymin, window.ymin);
  return vertices * std::max(0.0, width / all.width()) * std::max(0.0, height / all.height());
}

/// As measured on OS Terrain 50: 160 bytes a triangle of one surface, 350 with a scene, another 60 of a second one at
/// rest.
void require_memory(const StoreMetadata& metadata, const ZoneRequest& request, const Box& window, bool screened) {
  if (!request.memory_bytes) return;
  const double triangles = 2 * vertices_within(metadata, request, window);
  const double cells = request.grid ? static_cast<double>(request.grid->cell_count())
                                    : window.width() * window.height() / (*request.cell_size * *request.cell_size);
  const double words = static_cast<double>(turbine_bit(request.turbines.back().number).grid + 1);
  const bool scene = request.radar || request.nodata == NoData::kBlock;
  const double needed =
      ((scene ? 350 : 160) + (screened ? 60 : 0)) * triangles + (screened ? 2 : 1) * (36 + 4 * words) * cells;
  if (needed <= static_cast<double>(*request.memory_bytes)) return;
  throw InputError(
      fmt::format("this takes about {:.1f} GB of memory, more than the {:.1f} GB allowed: give a coarser "
                  "tolerance, larger cells or a smaller radius, or allow more",
                  needed / 1e9, static_cast<double>(*request.memory_bytes) / 1e9));
}

}  // namespace

Zone survey_turbines(const Tin& ground, const Tin* screened, const ZoneRequest& request, Progress& progress) {
  validate(request);
  if (ground.triangles.empty())
    throw InputError("no turbine stands on any data; see the CRS of the turbines and of the store");
  Zone zone;
  zone.request = request;
  Stopwatch watch;
  progress.report("scene", 0);
  std::optional<BinnedHeights> binned(std::in_place, ground);
  place_turbines(ground, *binned, zone);
  zone.grid = grid_of(zone.request, ground.bounds());
  std::size_t last = 0;
  for (const Turbine& t : zone.request.turbines) last = std::max(last, turbine_bit(t.number).grid);
  zone.words = last + 1;
  warn_of_voids(ground, binned->boundary(), zone);
  zone.statistics.retrieval = ground.statistics;
  zone.statistics.triangles = ground.triangles.size();
  const RasterGrid tiles = grid_of_tiles(zone.grid);
  const TriangleBins bins(ground, tiles);
  const ZoneSurvey lines(ground, bins, tiles, zone);
  std::optional<Scene> scene = curtains(ground, request);
  zone.statistics.scene_seconds = watch.lap();
  zone.bare = lines.run(AxisSweep(ground, request.earth, *binned), scene ? &*scene : nullptr, "sight lines",
                        zone.statistics.lines, progress);
  binned.reset();
  if (request.radar) {
    if (!scene) scene.emplace(ground, request.earth, request.nodata, ceiling(ground, request));
    const LeastHeights heights(ground, request.earth, *scene);
    zone.radar = radar_view(ground, *scene, bins, tiles, heights, zone, progress);
  }
  zone.statistics.lines_seconds = watch.lap();
  if (screened != nullptr) {
    // One surface at a time, for what is made of them takes memory.
    binned.emplace(*screened);
    scene = curtains(*screened, request);
    zone.statistics.scene_seconds += watch.lap();
    zone.screened = lines.run(AxisSweep(*screened, request.earth, *binned), scene ? &*scene : nullptr,
                              "sight lines, screened", zone.statistics.lines, progress);
    zone.statistics.lines_seconds += watch.lap();
    zone.statistics.retrieval += screened->statistics;
    zone.statistics.triangles += screened->triangles.size();
  }
  return zone;
}

Zone survey_turbines(const Store& store, const ZoneRequest& request, Progress& progress) {
  validate(request);
  Stopwatch watch;
  const bool stands = request.themes && request.themes->includes_standing(store.metadata().themes);
  const Window window = window_of(request);
  require_memory(store.metadata(), request, window.bounds(), stands);
  const Tin ground = triangulate(store, window, request.detail, progress, ThemeChoice::none());
  std::optional<Tin> screened;
  if (stands) screened = triangulate(store, window, request.detail, progress, *request.themes);
  const double seconds = watch.lap();
  Zone zone = survey_turbines(ground, screened ? &*screened : nullptr, request, progress);
  zone.statistics.retrieval_seconds = seconds;
  if (request.themes && !stands) {
    zone.screened = zone.bare;
    zone.warnings.emplace_back("none of the themes has features that stand on the ground: nothing screens");
  }
  return zone;
}

}  // namespace itin::viewshed
