// The squares of a grid that a triangle meets, or nearly meets.
//
//   const TriangleInBins triangle(tin, tin.triangles[t], grid);
//   for (std::int64_t row = triangle.box().north; row <= triangle.box().south; ++row) {
//     const auto [west, east] = triangle.columns_in(row);
//     ...
//   }
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include <itin/raster.hpp>
#include <itin/tin.hpp>

namespace itin::viewshed {

struct BinRange {
  std::int64_t west, east, north, south;  ///< inclusive; empty when west > east or north > south
};

class TriangleInBins {
 public:
  /// Nearly: `slack` bins away, by default no more than rounding.
  TriangleInBins(const Tin& tin, const Triangle& t, const RasterGrid& grid, double slack = 1e-6)
      : columns_(grid.columns()), slack_(slack) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Point3 p = tin.point(t[i]);
      corners_[i] = {grid.column_at(p.x), grid.row_at(p.y)};
    }
    const auto [north, south] =
        std::minmax_element(corners_.begin(), corners_.end(), [](Point2 a, Point2 b) { return a.y < b.y; });
    const auto [west, east] =
        std::minmax_element(corners_.begin(), corners_.end(), [](Point2 a, Point2 b) { return a.x < b.x; });
    box_ = {bin(west->x - slack_, columns_), bin(east->x + slack_, columns_), bin(north->y - slack_, grid.rows()),
            bin(south->y + slack_, grid.rows())};
    box_.west = std::max<std::int64_t>(0, box_.west), box_.east = std::min(box_.east, columns_ - 1);
    box_.north = std::max<std::int64_t>(0, box_.north), box_.south = std::min(box_.south, grid.rows() - 1);
  }

  const BinRange& box() const { return box_; }
  /// Most triangles meet nearly all of a small box; a long thin one across many bins only those along it.
  bool fills_box() const { return box_.east - box_.west < 3 || box_.south - box_.north < 3; }

  /// The columns that the triangle meets within a row: inclusive.
  std::pair<std::int64_t, std::int64_t> columns_in(std::int64_t row) const {
    const double top = static_cast<double>(row) - slack_, bottom = static_cast<double>(row + 1) + slack_;
    double west = std::numeric_limits<double>::infinity(), east = -west;
    const auto extend = [&](double x) { west = std::min(west, x), east = std::max(east, x); };
    for (std::size_t i = 0; i < 3; ++i) {
      const Point2 a = corners_[i], b = corners_[(i + 1) % 3];
      if (a.y >= top && a.y <= bottom) extend(a.x);
      for (const double y : {top, bottom})
        if ((a.y < y) != (b.y < y)) extend(a.x + (b.x - a.x) * ((y - a.y) / (b.y - a.y)));
    }
    return {std::max(box_.west, bin(west - slack_, columns_)), std::min(box_.east, bin(east + slack_, columns_))};
  }

 private:
  static std::int64_t bin(double v, std::int64_t count) {
    return static_cast<std::int64_t>(std::clamp(std::floor(v), -1.0, static_cast<double>(count)));
  }

  std::array<Point2, 3> corners_;
  std::int64_t columns_;
  double slack_;
  BinRange box_{};
};

}  // namespace itin::viewshed
