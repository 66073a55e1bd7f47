// The squares of a grid that a triangle meets, or nearly meets.
//
//   const VerticesInBins vertices(tin, grid);
//   const TriangleInBins triangle(vertices, tin.triangles[t]);
//   for (std::int64_t row = triangle.box().north; row <= triangle.box().south; ++row) {
//     const auto [west, east] = triangle.columns_in(row);
//     ...
//   }
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

#include <itin/raster.hpp>
#include <itin/tin.hpp>

#include "bounds/bin_bounds.hpp"
#include "line/infinity.hpp"

namespace itin::viewshed {

/// The positions of a surface's vertices in a grid: columns and rows from the grid's north-west corner, give or take
/// some 1e-9. Surface and grid must outlive this object.
class VerticesInBins {
 public:
  VerticesInBins(const Tin& tin, const RasterGrid& grid)
      : tin_(tin),
        columns_(grid.columns()),
        rows_(grid.rows()),
        west_(grid.column_at(tin.grid.origin.x)),
        north_(grid.row_at(tin.grid.origin.y)),
        columns_per_unit_(tin.grid.resolution / grid.cell_width()),
        rows_per_unit_(tin.grid.resolution / grid.cell_height()) {}

  Point2 operator[](std::uint32_t vertex) const {
    const GridPoint& v = tin_.vertices[vertex];
    return {west_ + v.x * columns_per_unit_, north_ - v.y * rows_per_unit_};
  }
  std::int64_t columns() const { return columns_; }
  std::int64_t rows() const { return rows_; }

 private:
  const Tin& tin_;
  std::int64_t columns_, rows_;
  double west_, north_, columns_per_unit_, rows_per_unit_;
};

class TriangleInBins {
 public:
  /// A bin is nearly met if it is at most `slack` bins away; the default is no more than rounding.
  TriangleInBins(const VerticesInBins& vertices, const Triangle& t, double slack = 1e-6)
      : corners_{vertices[t[0]], vertices[t[1]], vertices[t[2]]}, columns_(vertices.columns()), slack_(slack) {
    const auto& [a, b, c] = corners_;
    box_ = {std::max<std::int64_t>(0, bin_at(std::min({a.x, b.x, c.x}) - slack_, columns_)),
            std::min(bin_at(std::max({a.x, b.x, c.x}) + slack_, columns_), columns_ - 1),
            std::max<std::int64_t>(0, bin_at(std::min({a.y, b.y, c.y}) - slack_, vertices.rows())),
            std::min(bin_at(std::max({a.y, b.y, c.y}) + slack_, vertices.rows()), vertices.rows() - 1)};
  }

  const BinRange& box() const { return box_; }
  /// Whether all bins of the box count as met. Most triangles meet nearly all of a small box; a long thin one across
  /// many bins meets only those along it.
  bool fills_box() const { return box_.east - box_.west < 3 || box_.south - box_.north < 3; }

  /// The columns that the triangle meets within a row: inclusive.
  std::pair<std::int64_t, std::int64_t> columns_in(std::int64_t row) const {
    const double top = static_cast<double>(row) - slack_, bottom = static_cast<double>(row + 1) + slack_;
    double west = kInfinity, east = -west;
    const auto extend = [&](double x) { west = std::min(west, x), east = std::max(east, x); };
    for (std::size_t i = 0; i < 3; ++i) {
      const Point2 a = corners_[i], b = corners_[(i + 1) % 3];
      if (a.y >= top && a.y <= bottom) extend(a.x);
      for (const double y : {top, bottom})
        if ((a.y < y) != (b.y < y)) extend(a.x + (b.x - a.x) * ((y - a.y) / (b.y - a.y)));
    }
    return {std::max(box_.west, bin_at(west - slack_, columns_)), std::min(box_.east, bin_at(east + slack_, columns_))};
  }

 private:
  std::array<Point2, 3> corners_;
  std::int64_t columns_;
  double slack_;
  BinRange box_{};
};

}  // namespace itin::viewshed
