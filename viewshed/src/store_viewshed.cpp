#include <chrono>

#include <itin/error.hpp>
#include <itin/triangulate.hpp>
#include <viewshed/viewshed.hpp>

#include "request.hpp"

namespace itin::viewshed {

Surveyed compute_with_surface(const Store& store, const Request& request, Progress& progress) {
  validate(request);
  const auto start = std::chrono::steady_clock::now();
  Surveyed surveyed;
  surveyed.tin = triangulate(store, window_of(request), request.detail, progress, request.themes);
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  if (surveyed.tin.standing.empty() || (request.observers_on_surface && request.targets_on_surface)) {
    surveyed.result = compute(surveyed.tin, request, progress);
  } else {
    const Tin ground = triangulate(store, window_of(request), request.detail, progress, ThemeChoice::none());
    surveyed.result = compute(surveyed.tin, ground, request, progress);
  }
  surveyed.result.statistics.retrieval_seconds = elapsed.count();
  return surveyed;
}

Result compute(const Store& store, const Request& request, Progress& progress) {
  return compute_with_surface(store, request, progress).result;
}

}  // namespace itin::viewshed
