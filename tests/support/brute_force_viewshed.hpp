// Viewsheds the slow way: every triangle for every cell, in double precision.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include <itin/grid_units.hpp>
#include <itin/tin_heights.hpp>
#include <viewshed/result.hpp>

#include "line/sight_line.hpp"
#include "request/eye.hpp"
#include "request/field_of_view.hpp"

namespace itin::test {

/// A request of one observer, where voids are clear.
inline viewshed::Request look(Point2 position, double height, double target_height, double cell) {
  viewshed::Request request;
  request.observers = {{"o", position, height}};
  request.target_height = target_height;
  request.cell_size = cell;
  request.nodata = viewshed::NoData::kClear;
  return request;
}

/// Returns the verdicts of a plain viewshed of one observer. Observer and targets stand on `ground`, or on `surface`
/// where the request says so.
inline std::vector<viewshed::Verdict> brute_force(const Tin& surface, const Tin& ground,
                                                  const viewshed::Request& request, const RasterGrid& cells) {
  using namespace viewshed;
  const Tin &of_observers = request.observers_on_surface ? surface : ground,
            &of_targets = request.targets_on_surface ? surface : ground;
  const Observer& observer = request.observers.front();
  const Eye eye = eye_of(surface.grid, request, observer, height_on(of_observers, observer.position));
  const double resolution = surface.grid.resolution;
  const FieldOfView view(request, observer);
  std::vector<viewshed::Verdict> values(cells.cell_count(), Verdict::kOutside);
  for (std::int64_t row = 0; row < cells.rows(); ++row) {
    for (std::int64_t column = 0; column < cells.columns(); ++column) {
      const Point2 centre = cells.centre(column, row);
      const auto base = height_on(of_targets, centre);
      if (!base) continue;
      const double target = *base + request.target_height;
      const Point3 to{easting_in_units(surface.grid, centre.x), northing_in_units(surface.grid, centre.y),
                      target / resolution};
      const auto [dx, dy] = eye.offset_to(centre, {to.x, to.y});
      if (!view.contains(dx, dy, target - eye.elevation)) continue;
      viewshed::Verdict& value = values[cells.index({column, row})];
      value = Verdict::kVisible;
      if (eye.stands_at({to.x, to.y})) continue;
      const SightLine line(eye.units, to, request.earth.drop_coefficient() * resolution, kGrazing / resolution);
      const bool hidden = std::any_of(surface.triangles.begin(), surface.triangles.end(), [&](const Triangle& t) {
        return line.hidden_by(surface.vertices[t[0]], surface.vertices[t[1]], surface.vertices[t[2]]);
      });
      if (hidden) value = Verdict::kHidden;
    }
  }
  return values;
}

}  // namespace itin::test
