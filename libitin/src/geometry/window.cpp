#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include <fmt/format.h>

#include <itin/degrees.hpp>
#include <itin/error.hpp>
#include <itin/in_ring.hpp>
#include <itin/window.hpp>

namespace itin {

namespace {

// Shewchuk's bound for a 2x2 determinant of differences, (3 + 16 eps) eps, rounded up.
constexpr double kOrientationError = 4.5e-16;

void require_number(const char* shape, const char* what, double value) {
  if (!std::isfinite(value)) throw InputError(fmt::format("{}: {} is not a finite number", shape, what));
  if (std::abs(value) > Window::kLimit)
    throw InputError(fmt::format("{}: {} {} is beyond the limit of {} m", shape, what, value, Window::kLimit));
}

void require_position(const char* shape, Point2 p) {
  require_number(shape, "x", p.x);
  require_number(shape, "y", p.y);
}

void require_positive(const char* shape, const char* what, double value) {
  require_number(shape, what, value);
  if (value <= 0) throw InputError(fmt::format("{}: {} must be greater than 0, not {}", shape, what, value));
}

struct Edge {
  Point2 a;
  Point2 b;
  double xmin() const { return std::min(a.x, b.x); }
  double xmax() const { return std::max(a.x, b.x); }
};

/// Returns 1 where c lies left of ab, -1 right of it, 0 on it and where rounding could have decided the sign.
int certain_side(Point2 a, Point2 b, Point2 c) {
  const double left = (b.x - a.x) * (c.y - a.y), right = (b.y - a.y) * (c.x - a.x);
  const double side = left - right;
  if (std::abs(side) <= kOrientationError * (std::abs(left) + std::abs(right))) return 0;
  return side > 0 ? 1 : -1;
}

bool certainly_cross(const Edge& e, const Edge& f) {
  return certain_side(e.a, e.b, f.a) * certain_side(e.a, e.b, f.b) < 0 &&
         certain_side(f.a, f.b, e.a) * certain_side(f.a, f.b, e.b) < 0;
}

void append_edges(const Window::Ring& ring, std::vector<Edge>& edges) {
  for (std::size_t i = 0; i < ring.size(); ++i) edges.push_back({ring[i], ring[(i + 1) % ring.size()]});
}

void require_no_crossing(const Window::Polygon& part) {
  std::vector<Edge> edges;
  append_edges(part.outer, edges);
  for (const auto& hole : part.holes) append_edges(hole, edges);
  std::sort(edges.begin(), edges.end(), [](const Edge& e, const Edge& f) { return e.xmin() < f.xmin(); });
  for (std::size_t i = 0; i < edges.size(); ++i) {
    for (std::size_t j = i + 1; j < edges.size() && edges[j].xmin() <= edges[i].xmax(); ++j) {
      if (certainly_cross(edges[i], edges[j]))
        throw InputError(
            fmt::format("polygon: the edge from ({}, {}) to ({}, {}) crosses another edge; repair it first",
                        edges[i].a.x, edges[i].a.y, edges[i].b.x, edges[i].b.y));
    }
  }
}

/// Checks corners and drops repeated ones, the closing one included.
Window::Ring cleaned(const Window::Ring& ring) {
  for (const Point2& p : ring) require_position("polygon", p);
  Window::Ring result;
  std::unique_copy(ring.begin(), ring.end(), std::back_inserter(result));
  while (result.size() > 1 && result.front() == result.back()) result.pop_back();
  Window::Ring distinct = result;
  std::sort(distinct.begin(), distinct.end(),
            [](Point2 p, Point2 q) { return std::pair(p.x, p.y) < std::pair(q.x, q.y); });
  if (std::unique(distinct.begin(), distinct.end()) - distinct.begin() < 3)
    throw InputError("polygon: a ring needs at least three distinct corners");
  return result;
}

void require_area(const Window::Ring& ring) {
  double area = 0, magnitude = 0;
  const Point2 o = ring.front();
  for (std::size_t i = 1; i + 1 < ring.size(); ++i) {
    const double left = (ring[i].x - o.x) * (ring[i + 1].y - o.y), right = (ring[i].y - o.y) * (ring[i + 1].x - o.x);
    area += left - right;
    magnitude += std::abs(left) + std::abs(right);
  }
  if (std::abs(area) <= kOrientationError * magnitude * static_cast<double>(ring.size()))
    throw InputError(fmt::format("polygon: the ring at ({}, {}) has no area", o.x, o.y));
}

/// Returns the corners of an arc's circumscribed polyline of `parts` equal chords, each tangent at its middle;
/// clockwise.
Window::Ring arc(Point2 centre, double azimuth, double width, double radius, int parts) {
  const double step = width / parts;
  const double reach = radius / std::cos(in_radians(step) / 2);
  Window::Ring corners;
  corners.reserve(static_cast<std::size_t>(parts) + 2);
  for (int i = 0; i <= parts; ++i) {
    const double angle = in_radians(azimuth - width / 2 + i * step);
    corners.push_back({centre.x + reach * std::sin(angle), centre.y + reach * std::cos(angle)});
  }
  return corners;
}

}  // namespace

Window::Polygon Window::rectangle(const Box& b) {
  return {{{b.xmin, b.ymin}, {b.xmax, b.ymin}, {b.xmax, b.ymax}, {b.xmin, b.ymax}}, {}};
}

Window Window::all() {
  Window window;
  window.all_ = true;
  return window;
}

Window Window::box(const Box& b) {
  require_position("box", {b.xmin, b.ymin});
  require_position("box", {b.xmax, b.ymax});
  if (b.xmin >= b.xmax || b.ymin >= b.ymax)
    throw InputError(fmt::format("box: {},{},{},{} is empty; give xmin,ymin,xmax,ymax with xmin < xmax and ymin < ymax",
                                 b.xmin, b.ymin, b.xmax, b.ymax));
  Window window;
  window.parts_ = {rectangle(b)};
  return window;
}

Window Window::polygons(std::vector<Polygon> parts) {
  if (parts.empty()) throw InputError("polygon: there is none");
  for (Polygon& part : parts) {
    part.outer = cleaned(part.outer);
    for (Ring& hole : part.holes) hole = cleaned(hole);
    require_no_crossing(part);
    require_area(part.outer);
  }
  Window window;
  window.parts_ = std::move(parts);
  return window;
}

Window Window::disc(Point2 centre, double radius) {
  require_position("disc", centre);
  require_positive("disc", "radius", radius);
  Window window;
  window.parts_.push_back({arc(centre, 0, 360, radius, kArcSides), {}});
  window.parts_.front().outer.pop_back();  // the arc's end is its start
  return window;
}

Window Window::wedge(Point2 apex, double azimuth, double width, double radius) {
  require_position("wedge", apex);
  require_number("wedge", "azimuth", azimuth);
  require_number("wedge", "width", width);
  if (width <= 0 || width > 360)
    throw InputError(fmt::format("wedge: width must be more than 0 and at most 360 degrees, not {}", width));
  require_positive("wedge", "radius", radius);
  if (width == 360) return disc(apex, radius);
  const int parts = static_cast<int>(std::ceil(kArcSides * width / 360));
  Window window;
  window.parts_.push_back({arc(apex, std::remainder(azimuth, 360), width, radius, parts), {}});
  window.parts_.front().outer.push_back(apex);
  return window;
}

Window Window::corridor(Point2 from, Point2 to, double width) {
  require_position("corridor", from);
  require_position("corridor", to);
  require_positive("corridor", "width", width);
  const double length = distance(from, to);
  if (length == 0) throw InputError(fmt::format("corridor: both ends are ({}, {}); it has no length", from.x, from.y));
  const double nx = -(to.y - from.y) / length * width / 2, ny = (to.x - from.x) / length * width / 2;
  Window window;
  window.parts_ = {
      {{{from.x - nx, from.y - ny}, {to.x - nx, to.y - ny}, {to.x + nx, to.y + ny}, {from.x + nx, from.y + ny}}, {}}};
  return window;
}

Box Window::bounds() const {
  Box box;
  for (const Polygon& part : parts_)
    for (const Point2& p : part.outer) box.extend(p);
  return box;
}

bool Window::contains(Point2 position) const {
  return all_ || std::any_of(parts_.begin(), parts_.end(), [&](const Polygon& part) {
           return in_ring(part.outer, position) &&
                  std::none_of(part.holes.begin(), part.holes.end(),
                               [&](const Ring& hole) { return in_ring(hole, position); });
         });
}

}  // namespace itin
