#include "compute/store_viewshed.hpp"

#include <itin/triangulate.hpp>
#include <viewshed/viewshed.hpp>

#include "modes/blocked_features.hpp"
#include "progress/stopwatch.hpp"
#include "request/request.hpp"
#include "scene/reveal.hpp"
#include "window/near_ground.hpp"

namespace itin::viewshed {

namespace {

Surveyed survey(const Store& store, const Request& request, Surveyed surveyed, double seconds, Progress& progress) {
  surveyed.result = compute_on_surface(store, surveyed, request, progress);
  surveyed.result.statistics.retrieval_seconds = seconds;
  return surveyed;
}

}  // namespace

bool needs_tin(const Request& request) {
  return request.mode == Mode::kBlocker || request.mode == Mode::kProbability;
}

std::optional<Surveyed> compute_over_lattice(const Store& store, const Request& request, std::uint64_t most_posts,
                                             Progress& progress) {
  // At coarser levels nothing of the full one is looked at.
  if (needs_tin(request) || casts_rays(request) || level_within(store.metadata(), request.detail.coarsest()) != 0)
    return std::nullopt;
  Stopwatch watch;
  auto surface = retrieve_lattice(store, window_of(request), request.detail, request.themes,
                                  heights_for(request, store.points_about(0, box_of_window(store, request))),
                                  most_posts, progress);
  if (!surface) return std::nullopt;
  return survey(store, request, {std::move(*surface), std::nullopt, {}}, watch.lap(), progress);
}

Surveyed compute_over_tin(const Store& store, const Request& request, Progress& progress) {
  Stopwatch watch;
  Surveyed surveyed;
  Tin& tin = surveyed.surface.tin;
  tin = triangulate(store, window_of(request), request.detail, progress, request.themes);
  surveyed.surface.extent = extent_of(store);
  const double seconds = watch.lap();
  // Beside a feature the surface is not to the last digit the ground, also where the window holds no part of it.
  if (features_stand(store, request) && !(request.observers_on_surface && request.targets_on_surface))
    surveyed.ground = triangulate(store, window_of(request), request.detail, progress, ThemeChoice::none());
  return survey(store, request, std::move(surveyed), seconds, progress);
}

Surveyed compute_with_surface(const Store& store, const Request& request, Progress& progress) {
  validate(request);
  if (auto surveyed = compute_over_lattice(store, request, kAnyLattice, progress)) return std::move(*surveyed);
  return compute_over_tin(store, request, progress);
}

Result compute_on_surface(const Store& store, const Surveyed& surveyed, const Request& request, Progress& progress) {
  Result result = compute(surveyed.surface, surveyed.ground ? &*surveyed.ground : nullptr, request, progress);
  for (const ThemeInfo& theme : store.metadata().themes) result.theme_names.push_back(theme.name);
  if (request.mode == Mode::kBlocker) find_blocking_features(store, surveyed.surface.tin, result);
  return result;
}

Request alone(const Result& result, std::size_t observer) {
  Request request = result.request;
  request.observers = {result.request.observers[observer]};
  request.cell_size.reset();
  request.grid = result.grid;
  return request;
}

Result compute(const Store& store, const Request& request, Progress& progress) {
  return compute_with_surface(store, request, progress).result;
}

}  // namespace itin::viewshed
