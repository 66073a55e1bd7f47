#include "places/street_sight.hpp"

#include <algorithm>
#include <cmath>

#include <itin/grazing.hpp>
#include <itin/grid_units.hpp>

#include "line/sight_line.hpp"
#include "places/raised_end.hpp"

namespace itin::viewshed {

namespace {

Point3 nearest_street(std::span<const Point3> street, Point2 place) {
  const auto distance = [&](const Point3& p) { return std::hypot(p.x - place.x, p.y - place.y); };
  return *std::min_element(street.begin(), street.end(),
                           [&](const Point3& a, const Point3& b) { return distance(a) < distance(b); });
}

}  // namespace

std::optional<StreetSight> street_sight(const PlacedSurface& surface, const Earth& earth,
                                        std::span<const Point3> street, const RoofPlace& place) {
  if (street.empty()) return std::nullopt;
  const Grid& grid = surface.tin.grid;
  const Point3 from = nearest_street(street, place.position);
  const Point2 start = place_in_units(grid, {from.x, from.y}), end = place_in_units(grid, place.position);
  const SightLine line({start.x, start.y, from.z / grid.resolution}, {end.x, end.y, place.roof_m / grid.resolution},
                       earth.drop_coefficient() * grid.resolution, kGrazing / grid.resolution);
  const ClearedEnd highest = raised_end(surface, line);
  if (!std::isfinite(highest.z)) return std::nullopt;
  StreetSight sight{from, highest.z * grid.resolution - place.roof_m, {}};
  if (!highest.triangle) return sight;
  const SightLine raised = line.with_end(highest.z);
  const auto [a, b, c] = surface.pyramid->corners(*highest.triangle);
  const double at = raised.highest_at(a, b, c);
  const Point2 position = place_in_metres(grid, {start.x + at * line.dx(), start.y + at * line.dy()});
  const double z = line.from().z + at * (highest.z - line.from().z) - raised.bulge().at(at);
  sight.edge = {{position.x, position.y, z * grid.resolution},
                surface.tin.theme(surface.tin.triangles[*highest.triangle])};
  return sight;
}

}  // namespace itin::viewshed
