#include "bounds/surface_heights.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "line/grid_units.hpp"

namespace itin::viewshed {

namespace {

struct RowCrossing {
  double x = 0;
  double z = 0;
};

/// A triangle with its vertices in ascending order of (y, x), so that both triangles at an edge see the edge alike and
/// its crossings with a row agree to the last bit.
class RowSections {
 public:
  explicit RowSections(const std::array<GridPoint, 3>& corners) {
    std::transform(corners.begin(), corners.end(), corners_.begin(), [](const GridPoint& v) {
      return Point3{static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
    });
    order(0, 1), order(1, 2), order(0, 1);
  }

  double lowest() const { return corners_[0].y; }
  double highest() const { return corners_[2].y; }

  /// From west to east. Precondition: lowest() <= y <= highest().
  std::pair<RowCrossing, RowCrossing> at(double y) const {
    const auto& [a, b, c] = corners_;
    RowCrossing p = cross(a, c, y);
    RowCrossing q = y < b.y ? cross(a, b, y) : cross(b, c, y);
    if (y == b.y) q = {b.x, b.z};
    if (q.x < p.x) std::swap(p, q);
    return {p, q};
  }

  static double height(const RowCrossing& west, const RowCrossing& east, double x) {
    // On an edge as both triangles there have it, to the last bit.
    if (x == west.x || east.x == west.x) return west.z;
    if (x == east.x) return east.z;
    return west.z + (east.z - west.z) * ((x - west.x) / (east.x - west.x));
  }

 private:
  void order(std::size_t first, std::size_t second) {
    Point3 &a = corners_[first], &b = corners_[second];
    if (b.y != a.y ? b.y < a.y : b.x < a.x) std::swap(a, b);
  }

  static RowCrossing cross(const Point3& a, const Point3& b, double y) {
    if (y >= b.y) return {b.x, b.z};
    const double w = (y - a.y) / (b.y - a.y);
    return {a.x + w * (b.x - a.x), a.z + w * (b.z - a.z)};
  }

  std::array<Point3, 3> corners_;
};

/// Calls visit(cell, height function) for every cell centre in every triangle.
template <class Visit>
void for_each_centre(const Tin& tin, std::span<const std::uint32_t> triangles, const Tile& tile,
                     const TileCentres& centres, const Visit& visit) {
  const auto& [x, y] = centres;
  const auto a_unit = [](double first, double last, std::int64_t count) {
    return count > 1 ? static_cast<double>(count - 1) / std::abs(last - first) : 1.0;
  };
  const double columns_per_unit = a_unit(x[0], x[static_cast<std::size_t>(tile.columns - 1)], tile.columns);
  const double rows_per_unit = a_unit(y[0], y[static_cast<std::size_t>(tile.rows - 1)], tile.rows);
  // Rows and columns are found by spacing, give or take one, and then compared exactly.
  const auto first_at = [](double cells, std::int64_t limit) {
    return static_cast<std::int64_t>(std::clamp(std::floor(cells) - 1, 0.0, static_cast<double>(limit)));
  };
  for (const std::uint32_t t : triangles) {
    const RowSections sections(tin.corners(t));
    for (std::int64_t r = first_at((y[0] - sections.highest()) * rows_per_unit, tile.rows); r < tile.rows; ++r) {
      const double row_y = y[static_cast<std::size_t>(r)];
      if (row_y > sections.highest()) continue;
      if (row_y < sections.lowest()) break;
      const auto [west, east] = sections.at(row_y);
      for (std::int64_t c = first_at((west.x - x[0]) * columns_per_unit, tile.columns); c < tile.columns; ++c) {
        const double cell_x = x[static_cast<std::size_t>(c)];
        if (cell_x < west.x) continue;
        if (cell_x > east.x) break;
        visit(static_cast<std::size_t>(r * Tile::kSide + c),
              [&, &west = west, &east = east] { return RowSections::height(west, east, cell_x); });
      }
    }
  }
}

}  // namespace

void scan_convert(const Tin& tin, std::span<const std::uint32_t> triangles, const Tile& tile,
                  const TileCentres& centres, TileValues<double>& heights) {
  heights.fill(kNoSurface);
  for_each_centre(tin, triangles, tile, centres, [&](std::size_t cell, const auto& height) {
    if (std::isnan(heights[cell])) heights[cell] = height();
  });
}

void scan_convert_highest(const Tin& tin, std::span<const std::uint32_t> triangles, const Tile& tile,
                          const TileCentres& centres, TileValues<double>& heights) {
  heights.fill(kNoSurface);
  for_each_centre(tin, triangles, tile, centres, [&](std::size_t cell, const auto& height) {
    const double h = height();
    if (!(heights[cell] >= h)) heights[cell] = h;
  });
}

std::optional<double> surface_height(const Tin& tin, std::span<const std::uint32_t> triangles, Point2 position) {
  const Point2 units{easting_in_units(tin.grid, position.x), northing_in_units(tin.grid, position.y)};
  for (const std::uint32_t t : triangles)
    if (const auto height = height_over(tin.corners(t), units)) return height;
  return std::nullopt;
}

std::optional<double> height_over(const std::array<GridPoint, 3>& triangle, Point2 units) {
  const auto& [x, y] = units;
  const RowSections sections(triangle);
  if (y < sections.lowest() || y > sections.highest()) return std::nullopt;
  const auto [west, east] = sections.at(y);
  if (x < west.x || x > east.x) return std::nullopt;
  return RowSections::height(west, east, x);
}

double height_over(const FallingSquare& square, Point2 units) {
  const double west = square.west, east = west + square.side, south = square.south;
  const double w = (units.y - south) / square.side;
  const auto at = [&](double x, std::int32_t lower, std::int32_t upper) {
    return RowCrossing{x, lower + w * (static_cast<double>(upper) - lower)};
  };
  const RowCrossing diagonal = at(east + w * (west - east), square.se, square.nw);
  return units.x <= diagonal.x ? RowSections::height(at(west, square.sw, square.nw), diagonal, units.x)
                               : RowSections::height(diagonal, at(east, square.se, square.ne), units.x);
}

std::optional<double> height_on(const Tin& tin, Point2 position) {
  const Point2 units{easting_in_units(tin.grid, position.x), northing_in_units(tin.grid, position.y)};
  const auto beside = [&](const std::array<GridPoint, 3>& corners) {
    const auto& [a, b, c] = corners;
    return (a.x < units.x && b.x < units.x && c.x < units.x) || (a.x > units.x && b.x > units.x && c.x > units.x);
  };
  for (std::uint32_t i = 0; i < tin.triangles.size(); ++i) {
    if (beside(tin.corners(i))) continue;
    if (const auto height = height_over(tin.corners(i), units)) return *height * tin.grid.resolution;
  }
  return std::nullopt;
}

}  // namespace itin::viewshed
