#include "exact/store_viewshed.hpp"

#include <itin/call_progress.hpp>
#include <itin/precondition.hpp>
#include <itin/triangulate.hpp>
#include <viewshed/surface.hpp>
#include <viewshed/viewshed.hpp>

#include "modes/feature_names.hpp"
#include "modes/lines/triangle_studies.hpp"
#include "plan/effort.hpp"
#include "plan/memory.hpp"
#include "progress/stopwatch.hpp"
#include "request/request.hpp"
#include "request/request_window.hpp"
#include "scene/reveal.hpp"
#include "window/retrieval.hpp"

namespace itin::viewshed {

namespace {

/// About the share of the time that reading takes.
double share_of_reading(const Store& store, const Request& request, std::uint64_t points, SurfaceForm form) {
  const std::uint64_t cells = cells_of(request, extent_of(store)).cell_count();
  return effort_of_viewshed(request, points, cells, form).share_of_reading();
}

ViewshedWithSurface survey(const Request& request, ViewshedWithSurface computed, double seconds, const CellSink& sink,
                           Progress& progress) {
  computed.result = compute(*computed.surface, computed.ground ? &*computed.ground : nullptr, request, progress, sink);
  computed.result.statistics.retrieval_seconds = seconds;
  return computed;
}

}  // namespace

std::optional<ViewshedWithSurface> compute_over_lattice(const Store& store, const Request& request,
                                                        std::uint64_t most_posts, const CellSink& sink,
                                                        Progress& progress) {
  ITIN_PRECONDITION(takes_a_lattice(store, request));
  Stopwatch watch;
  CallProgress call(progress);
  const std::uint64_t points = store.points_about(0, box_of_window(store, request));
  const double share = share_of_reading(store, request, points, SurfaceForm::kPosts);
  auto surface = retrieve_lattice(store, window_of(request), request.detail, request.themes,
                                  heights_for(request, points), most_posts, call.step(share));
  if (!surface) return std::nullopt;
  return survey(request, {std::make_shared<RetrievedSurface>(std::move(*surface)), std::nullopt, true, {}}, watch.lap(),
                sink, call.step(1));
}

ViewshedWithSurface compute_over_tin(const Store& store, const Request& request, const CellSink& sink,
                                     Progress& progress) {
  Stopwatch watch;
  CallProgress call(progress);
  ViewshedWithSurface computed;
  computed.surface = std::make_shared<RetrievedSurface>();
  Tin& tin = computed.surface->tin;
  const std::uint64_t points = points_about(store, request.detail, box_of_window(store, request));
  const double share = share_of_reading(store, request, points, SurfaceForm::kTriangles);
  tin = triangulate(store, window_of(request), request.detail, call.step(share), request.themes);
  computed.surface->extent = extent_of(store);
  const double seconds = watch.lap();
  // Beside a feature the surface differs from the ground in the last digits, even where the window holds no part of the
  // feature.
  const bool on_ground = !(request.observers_on_surface && request.targets_on_surface);
  if (has_raised_features(store, request) && (on_ground || needs_bare_lines(request)))
    computed.ground = triangulate(store, window_of(request), request.detail, call.step(share), ThemeChoice::none());
  return survey(request, std::move(computed), seconds, sink, call.step(1));
}

Result compute_on_surface(const Store& store, const ViewshedWithSurface& computed, const Request& request,
                          Progress& progress) {
  Result result = compute(*computed.surface, computed.ground ? &*computed.ground : nullptr, request, progress);
  name_features(store, result, progress);
  return result;
}

}  // namespace itin::viewshed
