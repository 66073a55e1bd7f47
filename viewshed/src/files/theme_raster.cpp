#include <algorithm>
#include <array>

#include <itin/precondition.hpp>
#include <itin/triangulate.hpp>
#include <viewshed/theme_raster.hpp>

#include "line/cell_tiles.hpp"

namespace itin::viewshed {

namespace {

/// Cells per side of what is triangulated at once.
constexpr std::int64_t kCellsAtOnce = 512;

/// Tells whether a triangle, its edges included, holds a position.
bool triangle_holds(const std::array<Point3, 3>& triangle, Point2 p) {
  for (std::size_t i = 0; i < 3; ++i) {
    const Point3 &a = triangle[i], &b = triangle[(i + 1) % 3];
    if ((b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x) < 0) return false;
  }
  return true;
}

/// Marks the cells within the box that features stand on.
void mark_themes(const Tin& tin, const Box& within, const RasterGrid& grid, std::vector<std::uint8_t>& values) {
  for (const Triangle& t : tin.triangles) {
    const auto theme = static_cast<std::uint8_t>(tin.theme(t));
    if (theme == 0) continue;
    const std::array<Point3, 3> corners{tin.point(t[0]), tin.point(t[1]), tin.point(t[2])};
    Box box;
    for (const Point3& p : corners) box.extend(Point2{p.x, p.y});
    const CellRectangle cells = cells_meeting(grid, intersection(box, within));
    for (std::int64_t row = cells.row; row < cells.row + cells.rows; ++row) {
      for (std::int64_t column = cells.column; column < cells.column + cells.columns; ++column) {
        if (!triangle_holds(corners, grid.centre(column, row))) continue;
        std::uint8_t& value = values[grid.index({column, row})];
        value = value == 0 ? theme : std::min(value, theme);
      }
    }
  }
}

}  // namespace

std::vector<std::uint8_t> theme_raster(const Store& store, const RasterGrid& grid, const Detail& detail,
                                       const ThemeChoice& themes, Progress& progress) {
  ITIN_PRECONDITION(store.metadata().themes.size() <= 255);
  std::vector<std::uint8_t> values(grid.cell_count(), 0);
  NoProgress silent;
  for (std::int64_t row = 0; row < grid.rows(); row += kCellsAtOnce) {
    progress.report("features", static_cast<double>(row) / static_cast<double>(grid.rows()));
    for (std::int64_t column = 0; column < grid.columns(); column += kCellsAtOnce) {
      progress.throw_if_cancelled();
      const Box box = grid.part({column, row}, std::min(kCellsAtOnce, grid.columns() - column),
                                std::min(kCellsAtOnce, grid.rows() - row))
                          .bounds();
      if (store.greatest_feature_height(themes, box) == 0) continue;
      mark_themes(triangulate(store, Window::box(box), detail, silent, themes), box, grid, values);
    }
  }
  return values;
}

}  // namespace itin::viewshed
