#include "foliage/raised_centres.hpp"

#include <itin/silent_progress.hpp>
#include <itin/triangulate.hpp>

#include "line/cell_tiles.hpp"

namespace itin::viewshed {

namespace {

Point2 centre_of_cell(const RasterGrid& grid, std::size_t cell) {
  const RasterGrid::Cell place = place_of(grid, cell);
  return grid.centre(place.column, place.row);
}

}  // namespace

std::vector<double> heights_at_centres(const Store& store, const RasterGrid& grid, std::span<const std::size_t> cells,
                                       const Detail& detail, const ThemeChoice& themes, Progress& progress) {
  std::vector<Point2> places;
  for (const std::size_t cell : cells) places.push_back(centre_of_cell(grid, cell));
  SilentProgress quiet(progress);
  std::vector<double> heights;
  for (const auto& height : heights_at(store, places, detail, themes, quiet)) heights.push_back(*height);
  return heights;
}

std::vector<Point3> raised_centres(const RasterGrid& grid, std::span<const std::size_t> cells,
                                   std::span<const double> grounds, double height) {
  std::vector<Point3> raised;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const Point2 centre = centre_of_cell(grid, cells[i]);
    raised.push_back({centre.x, centre.y, grounds[i] + height});
  }
  return raised;
}

}  // namespace itin::viewshed
