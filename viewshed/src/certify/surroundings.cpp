#include "certify/surroundings.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <itin/silent_progress.hpp>

#include "line/infinity.hpp"
#include "request/request.hpp"
#include "request/request_window.hpp"
#include "window/retrieval.hpp"

namespace itin::viewshed {

namespace {

/// What is decided exactly about an observer has about this many points of the full surface, and at most this share.
constexpr double kPointsNearby = 32000, kShareNearby = 1.0 / 64;

}  // namespace

Surroundings::Surroundings(const Store& store, const Request& request, const RasterGrid& grid)
    : store_(store),
      request_(request),
      grid_(grid),
      points_(std::min(kPointsNearby,
                       kShareNearby * static_cast<double>(store.points_about(0, box_of_window(store, request))))) {}

double Surroundings::reach_of(const Observer& observer) const {
  return std::min(radius_with(store_, 0, observer.position, points_),
                  radius_of(request_, observer).value_or(kInfinity));
}

std::optional<ExactNearby> Surroundings::decide(const Observer& observer, Statistics& statistics,
                                                const Progress& progress) const {
  const double reach = reach_of(observer);
  const CellRectangle part = cells_meeting(grid_, square_about(observer.position, reach));
  if (part.columns <= 0 || part.rows <= 0 || reach < std::max(grid_.cell_width(), grid_.cell_height()) ||
      reach <= observer.min_radius.value_or(request_.min_radius))
    return std::nullopt;
  Request nearby = request_;
  nearby.observers = {observer};
  nearby.observers.front().radius = reach;
  nearby.detail = Detail::tolerance(0);
  nearby.grid = grid_.part({part.column, part.row}, part.columns, part.rows);
  nearby.cell_size.reset();
  SilentProgress reading(progress);
  ViewshedWithSurface exact = compute_with_surface(store_, nearby, {}, reading);
  statistics.lines += exact.result.statistics.lines;
  return ExactNearby{{part.column, part.row}, part.columns, part.rows, std::move(exact.result.visible)};
}

}  // namespace itin::viewshed
