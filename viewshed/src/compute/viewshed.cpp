#include <algorithm>

#include <viewshed/surface.hpp>
#include <viewshed/viewshed.hpp>

#include "bounds/boundary.hpp"
#include "bounds/surface_heights.hpp"
#include "modes/look_around.hpp"
#include "progress/stopwatch.hpp"
#include "request/eye.hpp"
#include "request/request.hpp"
#include "scene/full_surface.hpp"
#include "scene/reveal.hpp"

namespace itin::viewshed {

namespace {

/// One of the two is there; `bare` is null where ends stand on that. Cells are laid over `extent`.
Result compute_on(const Tin* tin, LatticeReader* reader, const Tin* bare, const Box& extent, const Request& request,
                  Progress& progress) {
  validate(request);
  Result result;
  const LatticeTin* const lattice = reader != nullptr ? &reader->lattice() : nullptr;
  const Grid& units = lattice != nullptr ? lattice->grid : tin->grid;
  result.statistics.triangles = lattice != nullptr ? lattice->triangle_count() : tin->triangles.size();
  result.statistics.retrieval = lattice != nullptr ? lattice->statistics : tin->statistics;
  if (result.statistics.triangles == 0) eye_of(units, request, request.observers.front(), std::nullopt);
  result.request = request;
  Stopwatch watch;
  progress.report("scene", 0);
  result.grid = cells_of(request, extent);
  const RasterGrid tiles = grid_of_tiles(result.grid);
  if (reader != nullptr && asks_for_all_heights(request)) reader->read_all(progress);
  FullSurface surface = lattice != nullptr ? FullSurface(*lattice, request.earth, result.grid, tiles)
                                           : FullSurface(*tin, request.targets_on_surface ? nullptr : bare,
                                                         request.earth, result.grid, tiles);
  if (casts_rays(request)) surface.cast_rays(request.earth, positions_of(request));
  std::vector<Eye> eyes;
  for (const Observer& observer : request.observers) {
    const bool raised = request.observers_on_surface || bare == nullptr;
    if (reader != nullptr) reveal_place(observer.position, *reader, surface, progress);
    const auto height = raised ? surface.height(observer.position) : height_on(*bare, observer.position);
    eyes.push_back(eye_of(units, request, observer, height));
    result.ground_m.push_back(*height);
  }
  look_for_voids(units, surface.rim(), result);
  result.statistics.scene_seconds = watch.lap();
  std::optional<TriangleStudies> studies;
  if (needs_triangles(request)) studies.emplace(request, *tin);
  Observations observations(request);
  std::vector<RadialSweep::View> views;
  if (reader != nullptr && !all_read(*reader))
    for (const Eye& eye : eyes) views.push_back(reveal(eye, *reader, surface, kAnyTiles, progress).view);
  look_around(surface, studies ? &*studies : nullptr, observations, eyes, views, result, progress);
  result.statistics.lines_seconds = watch.lap();
  return result;
}

}  // namespace

Result compute(const Tin& tin, const Request& request, Progress& progress) {
  return compute_on(&tin, nullptr, nullptr, tin.bounds(), request, progress);
}

Result compute(const Tin& tin, const Tin& ground, const Request& request, Progress& progress) {
  return compute_on(&tin, nullptr, &ground, tin.bounds(), request, progress);
}

Result compute(const Surface& surface, const Tin* ground, const Request& request, Progress& progress) {
  const Box extent = !surface.extent.empty() ? surface.extent
                     : surface.lattice       ? surface.lattice->lattice().bounds()
                                             : surface.tin.bounds();
  return compute_on(&surface.tin, surface.lattice.get(), ground, extent, request, progress);
}

}  // namespace itin::viewshed
