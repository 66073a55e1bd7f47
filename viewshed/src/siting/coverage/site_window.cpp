#include "siting/coverage/site_window.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <utility>

#include <itin/raster.hpp>

#include "plan/partition.hpp"

namespace itin::viewshed {

std::vector<std::size_t> all_options(const SiteSurvey& survey) {
  std::vector<std::size_t> all(survey.positions.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  return all;
}

Box reach_of(const SiteSurvey& survey) {
  return reach_of(survey, all_options(survey));
}

Box reach_of(const SiteSurvey& survey, std::span<const std::size_t> options) {
  Box box;
  for (const std::size_t option : options) box.extend(square_about(survey.positions[option].position, survey.radius));
  return box;
}

Window window_about(const SiteSurvey& survey, const std::vector<std::size_t>& options) {
  const std::vector<SitePosition>& positions = survey.positions;
  const double radius = survey.radius;
  if (options.size() == 1) return Window::disc(positions[options.front()].position, radius);
  const RasterGrid cells = RasterGrid::aligned(reach_of(survey, options), radius / 4);
  std::vector<bool> met(cells.cell_count());
  for (const std::size_t option : options) {
    const Box disc = square_about(positions[option].position, radius);
    // Aligned cells may end slightly within the box.
    const auto within = [](double at, std::int64_t count) {
      return std::clamp<std::int64_t>(static_cast<std::int64_t>(std::floor(at)), 0, count - 1);
    };
    const std::int64_t west = within(cells.column_at(disc.xmin), cells.columns()),
                       east = within(cells.column_at(disc.xmax), cells.columns()),
                       north = within(cells.row_at(disc.ymax), cells.rows()),
                       south = within(cells.row_at(disc.ymin), cells.rows());
    for (std::int64_t row = north; row <= south; ++row)
      for (std::int64_t column = west; column <= east; ++column) met[cells.index({column, row})] = true;
  }
  std::vector<Window::Polygon> runs;
  const Point2 corner = cells.north_west();
  const double side = cells.cell_width();
  for (std::int64_t row = 0; row < cells.rows(); ++row) {
    for (std::int64_t column = 0; column < cells.columns(); ++column) {
      const std::int64_t first = column;
      while (column < cells.columns() && met[cells.index({column, row})]) ++column;
      if (column == first) continue;
      const double west = corner.x + static_cast<double>(first) * side,
                   east = corner.x + static_cast<double>(column) * side,
                   north = corner.y - static_cast<double>(row) * side, south = north - side;
      runs.push_back(Window::rectangle({west, south, east, north}));
    }
  }
  return Window::polygons(std::move(runs));
}

std::pair<std::span<std::size_t>, std::span<std::size_t>> halves_across(const std::vector<SitePosition>& positions,
                                                                        std::span<std::size_t> sites) {
  Box box;
  for (const std::size_t site : sites) box.extend(positions[site].position);
  std::sort(sites.begin(), sites.end(), [&](std::size_t a, std::size_t b) {
    const Point2 p = positions[a].position, q = positions[b].position;
    const double pa = box.width() > box.height() ? p.x : p.y, pb = box.width() > box.height() ? q.x : q.y;
    return pa != pb ? pa < pb : a < b;
  });
  return halves(sites);
}

}  // namespace itin::viewshed
