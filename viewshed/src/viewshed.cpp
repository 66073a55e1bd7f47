#include <algorithm>
#include <limits>

#include <viewshed/viewshed.hpp>

#include "boundary.hpp"
#include "caster.hpp"
#include "eye.hpp"
#include "request.hpp"
#include "scene.hpp"
#include "stopwatch.hpp"
#include "surface_heights.hpp"
#include "triangle_bins.hpp"

namespace itin::viewshed {

namespace {

void look_for_voids(const Tin& tin, const std::vector<BoundaryEdge>& boundary, Result& result) {
  for (const Observer& observer : result.request.observers) {
    const double reach = radius_of(result.request, observer).value_or(std::numeric_limits<double>::infinity());
    result.crosses_voids = result.crosses_voids || surface_resumes(tin, boundary, observer.position, reach);
  }
  if (result.crosses_voids && result.request.nodata == NoData::kUnknown) result.warnings.emplace_back(kVoidsWarning);
}

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
  const Scene scene(tin, request.earth, request.nodata, ceiling_of(tin, request));
  const Tin* const base = request.observers_on_surface ? nullptr : ground;
  std::vector<Eye> eyes;
  for (const Observer& observer : request.observers) {
    const auto height = base != nullptr ? height_on(*base, observer.position) : scene.ground(observer.position);
    eyes.push_back(eye_of(tin.grid, request, observer, height));
    result.ground_m.push_back(*height);
  }
  result.grid = cells_of(request, tin.bounds());
  look_for_voids(tin, scene.boundary(), result);
  result.statistics.triangles = tin.triangles.size();
  result.statistics.retrieval = tin.statistics;
  result.statistics.scene_seconds = watch.lap();

  const Tin& targets = ground != nullptr && !request.targets_on_surface ? *ground : tin;
  const Tin* const cover = &targets == &tin ? nullptr : &tin;
  const TriangleBins bins(targets, grid_of_tiles(result.grid));
  const Observations observations(result.request, eyes, tin, scene);
  Caster(targets, bins, cover, scene, eyes, observations, result).run(progress);
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
