#include "workflows/zone/output/study_lines.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include <itin/contour_lines.hpp>
#include <itin/parallel.hpp>
#include <viewshed/zone_files.hpp>

namespace itin::viewshed {

namespace {

constexpr Rgba kRing{70, 70, 70, 255}, kStudyArea{20, 20, 20, 255}, kRoute{0, 110, 60, 255}, kLink{150, 20, 110, 255};

double nearest_turbine(const std::vector<Turbine>& turbines, Point2 p) {
  double least = std::numeric_limits<double>::infinity();
  for (const Turbine& t : turbines) least = std::min(least, distance(t.position, p));
  return least;
}

/// Values of a function of the position over a box, close enough for smooth lines.
struct PlaneField {
  RasterGrid grid;
  std::vector<float> values;

  template <class Value>
  PlaneField(const Box& box, const Value& value) {
    constexpr double kAcross = 800;
    const double step = std::max(box.width(), box.height()) / kAcross;
    grid = {{box.xmin - 2 * step, box.ymax + 2 * step},
            step,
            step,
            static_cast<std::int64_t>(box.width() / step) + 5,
            static_cast<std::int64_t>(box.height() / step) + 5};
    values.resize(grid.cell_count());
    parallel_for(static_cast<std::size_t>(grid.rows()), [&](std::size_t row) {
      for (std::int64_t column = 0; column < grid.columns(); ++column) {
        const RasterGrid::Cell cell{column, static_cast<std::int64_t>(row)};
        values[grid.index(cell)] = static_cast<float>(value(grid.centre(cell.column, cell.row)));
      }
    });
  }

  void add_lines(double level, const std::string& label, profile::SheetLines& lines) const {
    for (auto& points : contour_lines(grid, values, level)) lines.lines.push_back({std::move(points), label});
  }
};

/// Returns the step of the rings of distance to the nearest turbine: 5 km; 1 km in small study areas, 10 km in large
/// ones.
double ring_step(double farthest) {
  return farthest <= 7500 ? 1000 : farthest <= 50000 ? 5000 : 10000;
}

void add_distances(const ZoneRequest& request, StudyLines& lines) {
  const std::vector<Turbine> turbines = turbines_of_study_area(request);
  const Box box = study_area(turbines);
  double farthest = 0;
  for (const Turbine& t : turbines) farthest = std::max(farthest, t.radius);
  const double step = ring_step(farthest);
  lines.rings_text = fmt::format("Distance to the nearest {}turbine, every {:g} km",
                                 has_proposal(request) ? "proposed " : "", step / 1000);
  const PlaneField to_nearest(box, [&](Point2 p) { return nearest_turbine(turbines, p); });
  for (double at = step; at < farthest; at += step)
    to_nearest.add_lines(at, fmt::format("{:g} km", at / 1000), lines.rings);
  PlaneField(box, [&](Point2 p) { return beyond_study_area(turbines, p); }).add_lines(0, "", lines.study_area);
}

}  // namespace

StudyLines study_lines(const ZoneStudy& study) {
  StudyLines lines{.routes = {{}, kRoute, 0.6, false},
                   .radio_links = {{}, kLink, 0.3, true},
                   .rings = {{}, kRing, 0.15, false},
                   .study_area = {{}, kStudyArea, 0.4, true}};
  for (const StudiedRoute& route : study.routes) lines.routes.lines.push_back({route.route.corners, route.title()});
  for (const profile::Link& link : study.request.links.links)
    lines.radio_links.lines.push_back({{link.from, link.to}, link.id});
  add_distances(study.zone.request, lines);
  return lines;
}

Box study_area(const std::vector<Turbine>& turbines) {
  Box box;
  for (const Turbine& t : turbines) {
    box.extend(Point2{t.position.x - t.radius, t.position.y - t.radius});
    box.extend(Point2{t.position.x + t.radius, t.position.y + t.radius});
  }
  return box;
}

double beyond_study_area(const std::vector<Turbine>& turbines, Point2 p) {
  double least = std::numeric_limits<double>::infinity();
  for (const Turbine& t : turbines) least = std::min(least, distance(t.position, p) - t.radius);
  return least;
}

}  // namespace itin::viewshed
