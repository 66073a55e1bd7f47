#include "window/retrieval.hpp"

#include <algorithm>
#include <cmath>

#include <itin/level_choice.hpp>
#include <itin/silent_progress.hpp>
#include <itin/triangulate.hpp>
#include <viewshed/surface.hpp>

#include "request/request.hpp"
#include "request/request_window.hpp"

namespace itin::viewshed {

namespace {

/// Points of one level about one observer, and about all observers; never more than this share of the full surface.
constexpr double kNearPoints = 16000, kAllNearPoints = 400000, kNearShare = 1.0 / 64;

}  // namespace

std::optional<double> height_at(const Store& store, Point2 position, const ThemeChoice& themes, Progress& progress,
                                const Detail& detail) {
  SilentProgress quiet(progress);
  return heights_at(store, {position}, detail, themes, quiet).front();
}

Tin coverage_of(const Store& store, const Window& window, Progress& progress) {
  SilentProgress quiet(progress);
  return triangulate(store, window, Detail::tolerance(store.metadata().levels.back().tolerance), quiet);
}

std::vector<Eye> eyes_on_surface(const Store& store, const Request& request, const Detail& detail,
                                 std::vector<double>& ground, Progress& progress) {
  const Grid& grid = store.metadata().grid;
  std::vector<Point2> positions;
  for (const Observer& observer : request.observers) positions.push_back(observer.position);
  SilentProgress quiet(progress);
  const auto heights =
      heights_at(store, positions, detail, request.observers_on_surface ? request.themes : ThemeChoice::none(), quiet);
  std::vector<Eye> eyes;
  for (std::size_t i = 0; i < heights.size(); ++i) {
    eyes.push_back(eye_of(grid, request, request.observers[i], heights[i]));
    ground.push_back(*heights[i]);
  }
  return eyes;
}

double points_per_square_metre(const Store& store, int level, const Request& request) {
  const Box box = box_of_window(store, request);
  return static_cast<double>(store.points_about(level, box)) / (box.width() * box.height());
}

double radius_with(const Store& store, int level, Point2 centre, double points) {
  const Box all = extent_of(store);
  const double greatest = std::max(all.width(), all.height());
  double radius = store.metadata().grid.resolution;
  // The radius grows in steps of a square root of 2.
  while (radius < greatest &&
         static_cast<double>(store.points_about(level, square_about(centre, std::sqrt(2) * radius))) <= points)
    radius *= std::sqrt(2);
  return radius;
}

EnvelopeRequest certified_request(const Store& store, const Request& request, int level, int surface) {
  EnvelopeRequest result;
  result.window = window_of(request);
  result.level = level;
  result.surface = surface;
  result.cut_by = request.themes;
  const Box box = box_of_window(store, request);
  const double points = std::min({kNearPoints, kAllNearPoints / static_cast<double>(request.observers.size()),
                                  kNearShare * static_cast<double>(store.points_about(0, box))});
  for (const Observer& observer : request.observers) {
    for (int finer = surface; finer < level; ++finer) {
      double radius = radius_with(store, finer, observer.position, points);
      if (const auto reach = radius_of(request, observer)) radius = std::min(radius, *reach);
      result.discs.push_back({observer.position, radius, finer});
    }
  }
  return result;
}

EnvelopeRequest certified_request(const Store& store, const Request& request) {
  EnvelopeRequest result = certified_request(store, request, level_within(store.metadata(), request.detail.coarsest()));
  const std::vector<Ring>& rings = request.detail.rings();
  for (std::size_t i = 0; i + 1 < rings.size(); ++i) {
    const int level = level_within(store.metadata(), rings[i].tolerance);
    if (level < result.level) result.discs.push_back({request.detail.centre(), rings[i].radius, level});
  }
  return result;
}

}  // namespace itin::viewshed
