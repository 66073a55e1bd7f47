#include "compute/surface_in_memory.hpp"

#include <algorithm>
#include <utility>

#include <itin/call_progress.hpp>
#include <viewshed/surface.hpp>
#include <viewshed/viewshed.hpp>

#include "bounds/surface_heights.hpp"
#include "modes/observe.hpp"
#include "progress/stopwatch.hpp"
#include "request/eye.hpp"
#include "request/request.hpp"
#include "request/void_shadow.hpp"
#include "scene/full_surface.hpp"
#include "scene/reveal.hpp"

namespace itin::viewshed {

namespace {

Result begin_result(const SurfaceInMemory& over, const Request& request) {
  validate(request);
  Result result;
  result.statistics.triangles = over.lattice != nullptr ? over.lattice->triangle_count() : over.tin->triangles.size();
  result.statistics.retrieval = over.lattice != nullptr ? over.lattice->statistics : over.tin->statistics;
  if (result.statistics.triangles == 0) eye_of(over.units(), request, request.observers.front(), std::nullopt);
  result.request = request;
  result.grid = cells_of(request, over.extent);
  return result;
}

std::vector<Eye> eyes_over(const SurfaceInMemory& over, FullSurface& surface, Result& result, Progress& progress) {
  std::vector<Eye> eyes;
  const Request& request = result.request;
  for (const Observer& observer : request.observers) {
    const bool raised = request.observers_on_surface || over.bare == nullptr;
    if (over.reader != nullptr) reveal_place(observer.position, *over.reader, surface, progress);
    const auto height = raised ? surface.height(observer.position) : height_on(*over.bare, observer.position);
    eyes.push_back(eye_of(over.units(), request, observer, height));
    result.ground_m.push_back(*height);
  }
  return eyes;
}

}  // namespace

Result compute(const SurfaceInMemory& over, const Request& request, Progress& progress) {
  Stopwatch watch;
  CallProgress call(progress);
  call.report("scene", 0);
  Result result = begin_result(over, request);
  const RasterGrid tiles = grid_of_tiles(result.grid);
  if (over.reader != nullptr && asks_for_all_heights(request)) over.reader->read_all(call);
  auto heights = over.heights          ? over.heights
                 : over.tin != nullptr ? std::make_shared<BinnedHeights>(*over.tin, result.grid.cell_area())
                                       : std::make_shared<BinnedHeights>(*over.lattice);
  FullSurface surface(std::move(heights), over.tin, request.targets_on_surface ? nullptr : over.bare, request.earth,
                      result.grid, tiles);
  if (casts_rays(request)) surface.cast_rays(request.earth, positions_of(request));
  const std::vector<Eye> eyes = eyes_over(over, surface, result, call);
  find_voids(over.units(), surface.rim(), result);
  result.statistics.scene_seconds = watch.lap();
  std::optional<TriangleStudies> studies;
  if (needs_triangles(request)) studies.emplace(request, *over.tin, over.bare);
  std::vector<RadialSweep::View> views;
  if (over.reader != nullptr && !all_read(*over.reader))
    for (const Eye& eye : eyes) views.push_back(reveal(eye, *over.reader, surface, kAnyTiles, call).view);
  observe_all(surface, studies ? &*studies : nullptr, eyes, std::move(views), result, call);
  result.statistics.lines_seconds = watch.lap();
  call.finish();
  return result;
}

Result compute(const Tin& tin, const Request& request, Progress& progress) {
  return compute(SurfaceInMemory{.tin = &tin, .extent = tin.bounds()}, request, progress);
}

Result compute(const Tin& tin, const Tin& ground, const Request& request, Progress& progress) {
  return compute(SurfaceInMemory{.tin = &tin, .bare = &ground, .extent = tin.bounds()}, request, progress);
}

Result compute(const Surface& surface, const Tin* ground, const Request& request, Progress& progress) {
  SurfaceInMemory over{.bare = ground, .extent = surface.extent};
  if (surface.lattice) {
    over.reader = surface.lattice.get(), over.lattice = &surface.lattice->lattice();
  } else {
    over.tin = &surface.tin;
  }
  if (over.extent.empty()) over.extent = over.lattice != nullptr ? over.lattice->bounds() : over.tin->bounds();
  return compute(over, request, progress);
}

}  // namespace itin::viewshed
