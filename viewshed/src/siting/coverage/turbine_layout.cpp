#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include <itin/degrees.hpp>
#include <itin/error.hpp>
#include <itin/raster.hpp>
#include <itin/segment_distance.hpp>
#include <viewshed/turbine_layout.hpp>

#include "line/cell_tiles.hpp"
#include "line/infinity.hpp"

namespace itin::viewshed {

namespace {

constexpr double kMostPlaces = 1e6;

double metres_to(const Window::Ring& ring, Point2 position) {
  double least = kInfinity;
  for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++)
    least = std::min(least, distance_to_segment(position, ring[j], ring[i]));
  return least;
}

}  // namespace

std::vector<Point2> spaced_positions(const Window& area, double side) {
  const Box box = area.bounds();
  if (box.width() / side * (box.height() / side) > kMostPlaces)
    throw InputError(fmt::format("a spacing of {:g} m makes more than {:g} places in the search area: give a greater",
                                 side, kMostPlaces),
                     "spacing");
  const RasterGrid squares = RasterGrid::aligned(box, side);
  std::vector<Point2> places;
  for (std::int64_t row = 0; row < squares.rows(); ++row)
    for (std::int64_t column = 0; column < squares.columns(); ++column)
      if (const Point2 middle = squares.centre(column, row); area.contains(middle)) places.push_back(middle);
  if (places.empty())
    throw InputError(
        fmt::format("no middle of a square of {:g} m lies in the search area: give a smaller spacing", side),
        "spacing");
  return places;
}

bool TurbineSpacing::keeps_apart(Point2 a, Point2 b) const {
  const double east = b.x - a.x, north = b.y - a.y, wind = in_radians(wind_from_deg);
  const double with_wind = (east * std::sin(wind) + north * std::cos(wind)) / along;
  const double beside = (east * std::cos(wind) - north * std::sin(wind)) / across;
  return with_wind * with_wind + beside * beside >= 1 - 1e-9;
}

Dwellings::Dwellings(std::vector<Point2> points, std::optional<Window> polygons) : points_(std::move(points)) {
  if (!polygons) return;
  for (const Window::Polygon& part : polygons->parts()) {
    const Window outline = Window::polygons({part});
    polygons_.push_back({outline, outline.bounds()});
  }
}

double Dwellings::metres_to(Point2 position, double most) const {
  double least = most;
  for (const Point2& point : points_) least = std::min(least, distance(point, position));
  for (const Polygon& polygon : polygons_) {
    if (squared_distance(position, polygon.bounds) >= least * least) continue;
    if (polygon.outline.contains(position)) return 0;
    const Window::Polygon& part = polygon.outline.parts().front();
    least = std::min(least, viewshed::metres_to(part.outer, position));
    for (const Window::Ring& hole : part.holes) least = std::min(least, viewshed::metres_to(hole, position));
  }
  return least;
}

}  // namespace itin::viewshed
