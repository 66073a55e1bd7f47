#include <itin/error.hpp>
#include <itin/triangulate.hpp>
#include <viewshed/viewshed.hpp>

#include "blocked_features.hpp"
#include "request.hpp"
#include "stopwatch.hpp"

namespace itin::viewshed {

Surveyed compute_with_surface(const Store& store, const Request& request, Progress& progress) {
  validate(request);
  Stopwatch watch;
  Surveyed surveyed;
  surveyed.tin = triangulate(store, window_of(request), request.detail, progress, request.themes);
  const double seconds = watch.lap();
  if (!surveyed.tin.standing.empty() && !(request.observers_on_surface && request.targets_on_surface))
    surveyed.ground = triangulate(store, window_of(request), request.detail, progress, ThemeChoice::none());
  surveyed.result = compute_on_surface(store, surveyed, request, progress);
  surveyed.result.statistics.retrieval_seconds = seconds;
  return surveyed;
}

Result compute_on_surface(const Store& store, const Surveyed& surveyed, const Request& request, Progress& progress) {
  Result result = surveyed.ground ? compute(surveyed.tin, *surveyed.ground, request, progress)
                                  : compute(surveyed.tin, request, progress);
  for (const ThemeInfo& theme : store.metadata().themes) result.theme_names.push_back(theme.name);
  if (request.mode == Mode::kBlocker) find_blocking_features(store, surveyed.tin, result);
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
