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

/// `ground` is null where it is the surface itself.
Result compute_on(const Tin& tin, const Tin* ground, const Request& request, Progress& progress) {
  validate(request);
  if (tin.triangles.empty()) eye_of(tin.grid, request, request.observers.front(), std::nullopt);
  Result result;
  result.request = request;
  Stopwatch watch;
  progress.report("scene", 0);
  result.grid = cells_of(request, tin.bounds());
  const RasterGrid tiles = grid_of_tiles(result.grid);
  const FullSurface surface(tin, request.targets_on_surface ? nullptr : ground, request.earth, result.grid, tiles);
  std::vector<Eye> eyes;
  for (const Observer& observer : request.observers) {
    const bool raised = request.observers_on_surface || ground == nullptr;
    const auto height = raised ? surface.height(observer.position) : height_on(*ground, observer.position);
    eyes.push_back(eye_of(tin.grid, request, observer, height));
    result.ground_m.push_back(*height);
  }
  look_for_voids(tin, surface.boundary(), result);
  result.statistics.triangles = tin.triangles.size();
  result.statistics.retrieval = tin.statistics;
  result.statistics.scene_seconds = watch.lap();
  look_around(surface, eyes, result, progress);
  if (request.mode == Mode::kBlocker) name_blockers(tin, result);
  result.statistics.rays_seconds = watch.lap();
  return result;
}

}  // namespace

Result compute(const Tin& tin, const Request& request, Progress& progress) {
  return compute_on(tin, nullptr, request, progress);
}

Result compute(const Tin& tin, const Tin& ground, const Request& request, Progress& progress) {
  return compute_on(tin, &ground, request, progress);
}

}  // namespace itin::viewshed
