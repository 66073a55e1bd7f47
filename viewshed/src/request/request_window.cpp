#include "request/request_window.hpp"

#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include <viewshed/surface.hpp>

#include "line/hulls.hpp"
#include "request/request.hpp"

namespace itin::viewshed {

std::vector<Point2> hull_about(Point2 observer, const Box& box) {
  // The hull has an area even where the box is empty.
  constexpr double kMetre = 1;
  std::vector<Point2> corners;
  add_corners(square_about(observer, kMetre), corners);
  if (!box.empty()) add_corners(box, corners);
  return hull_of(std::move(corners));
}

namespace {

/// The part of the window that one observer needs.
Window::Polygon part_of(const Request& request, const Observer& observer) {
  const std::optional<double> radius = radius_of(request, observer);
  if (!request.grid) return Window::disc(observer.position, *radius).parts().front();
  const Box cells = request.grid->bounds();
  return {hull_about(observer.position, radius ? intersection(cells, square_about(observer.position, *radius)) : cells),
          {}};
}

/// From this many observers on, those that stand within half a radius of each other share a part of the window.
constexpr std::size_t kCrowd = 256;

/// Groups observers of about the same radius in the same square of a grid, whose side is at most half the radius.
std::map<std::array<double, 3>, std::vector<const Observer*>> crowds_of(const Request& request) {
  std::map<std::array<double, 3>, std::vector<const Observer*>> crowds;
  for (const Observer& observer : request.observers) {
    const std::optional<double> radius = radius_of(request, observer);
    const double side = radius ? std::exp2(std::floor(std::log2(*radius)) - 1) : 0;
    const auto square = [&](double v) { return radius ? std::floor(v / side) : 0; };
    crowds[{side, square(observer.position.x), square(observer.position.y)}].push_back(&observer);
  }
  return crowds;
}

}  // namespace

Window window_of(const Request& request) {
  if (!all_bounded(request) && !request.grid) return Window::all();
  std::vector<Window::Polygon> parts;
  if (request.observers.size() < kCrowd) {
    for (const Observer& observer : request.observers) parts.push_back(part_of(request, observer));
    return Window::polygons(std::move(parts));
  }
  for (const auto& [square, crowd] : crowds_of(request)) {
    if (crowd.size() == 1) {
      parts.push_back(part_of(request, *crowd.front()));
      continue;
    }
    Box box;
    for (const Observer* const observer : crowd)
      for (const Point2& corner : part_of(request, *observer).outer) box.extend(corner);
    parts.push_back(Window::rectangle(box));
  }
  return Window::polygons(std::move(parts));
}

Box area_under(const Store& store, const Request& request) {
  const Window window = window_of(request);
  const Box all = extent_of(store);
  return window.is_all() ? all : intersection(window.bounds(), all);
}

Box box_of_window(const Store& store, const Request& request) {
  const Box within = area_under(store, request);
  // An error tells later on that an observer is outside the data.
  return within.empty() ? window_of(request).bounds() : within;
}

}  // namespace itin::viewshed
