#include <algorithm>

#include <viewshed/viewshed.hpp>

#include "boundary.hpp"
#include "eye.hpp"
#include "full_surface.hpp"
#include "look_around.hpp"
#include "request.hpp"
#include "stopwatch.hpp"
#include "surface_heights.hpp"

namespace itin::viewshed {

namespace {

void name_blockers(const Tin& tin, Result& result) {
  result.blocker_theme.resize(result.blocker.size());
  std::transform(result.blocker.begin(), result.blocker.end(), result.blocker_theme.begin(), [&](std::uint32_t b) {
    return b == kNoBlocker || b == kMissingGround ? b : std::uint32_t{tin.theme(tin.triangles[b])};
  });
}

/// What is looked over.
struct Ground {
  const Tin* tin = nullptr;  ///< or
  const LatticeTin* lattice = nullptr;
  const Tin* bare = nullptr;  ///< what ends stand on, where that is not the surface
  const Grid& units() const { return lattice != nullptr ? lattice->grid : tin->grid; }
  Box bounds() const { return lattice != nullptr ? lattice->bounds() : tin->bounds(); }
  std::size_t triangles() const { return lattice != nullptr ? lattice->triangle_count() : tin->triangles.size(); }
};

Observations observations_over(const Ground& ground, const Request& request) {
  return ground.lattice != nullptr ? Observations(request) : Observations(request, *ground.tin);
}

Result compute_on(const Ground& ground, const Request& request, Progress& progress) {
  validate(request);
  Result result;
  result.statistics.triangles = ground.triangles();
  if (result.statistics.triangles == 0) eye_of(ground.units(), request, request.observers.front(), std::nullopt);
  result.request = request;
  Stopwatch watch;
  progress.report("scene", 0);
  result.grid = cells_of(request, ground.bounds());
  const RasterGrid tiles = grid_of_tiles(result.grid);
  const Tin* const bare = request.targets_on_surface ? nullptr : ground.bare;
  const FullSurface surface = ground.lattice != nullptr
                                  ? FullSurface(*ground.lattice, request.earth, result.grid, tiles)
                                  : FullSurface(*ground.tin, bare, request.earth, result.grid, tiles);
  std::vector<Eye> eyes;
  for (const Observer& observer : request.observers) {
    const bool raised = request.observers_on_surface || ground.bare == nullptr;
    const auto height = raised ? surface.height(observer.position) : height_on(*ground.bare, observer.position);
    eyes.push_back(eye_of(ground.units(), request, observer, height));
    result.ground_m.push_back(*height);
  }
  look_for_voids(ground.units(), surface.rim(), result);
  result.statistics.retrieval = ground.lattice != nullptr ? ground.lattice->statistics : ground.tin->statistics;
  result.statistics.scene_seconds = watch.lap();
  look_around(surface, observations_over(ground, request), eyes, result, progress);
  if (request.mode == Mode::kBlocker) name_blockers(*ground.tin, result);
  result.statistics.rays_seconds = watch.lap();
  return result;
}

}  // namespace

Result compute(const Tin& tin, const Request& request, Progress& progress) {
  return compute_on({.tin = &tin}, request, progress);
}

Result compute(const LatticeTin& lattice, const Request& request, Progress& progress) {
  return compute_on({.lattice = &lattice}, request, progress);
}

Result compute(const Tin& tin, const Tin& ground, const Request& request, Progress& progress) {
  return compute_on({.tin = &tin, .bare = &ground}, request, progress);
}

}  // namespace itin::viewshed
