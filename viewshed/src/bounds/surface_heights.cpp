#include "bounds/surface_heights.hpp"

#include <algorithm>
#include <cmath>

#include <itin/grid_units.hpp>
#include <itin/precondition.hpp>

namespace itin::viewshed {

namespace {

/// Calls visit(cell, height function) for every cell centre in every triangle.
template <class Visit>
void for_each_centre(const Tin& tin, std::span<const std::uint32_t> triangles, const Tile& tile,
                     const TileCentres& centres, const Visit& visit) {
  const auto& [x, y] = centres;
  const auto a_unit = [](double first, double last, std::int64_t count) {
    return count > 1 && last != first ? static_cast<double>(count - 1) / std::abs(last - first) : 1.0;
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
  return height_over(tin, triangles, place_in_units(tin.grid, position));
}

double height_over(const FallingSquare& square, Point2 units) {
  const double west = square.west, east = west + square.side, south = square.south;
  ITIN_PRECONDITION(west < units.x && units.x < east && south < units.y && units.y < south + square.side);
  const double w = (units.y - south) / square.side;
  const auto at = [&](double x, std::int32_t lower, std::int32_t upper) {
    return RowCrossing{x, lower + w * (static_cast<double>(upper) - lower)};
  };
  const RowCrossing diagonal = at(east + w * (west - east), square.se, square.nw);
  return units.x <= diagonal.x ? RowSections::height(at(west, square.sw, square.nw), diagonal, units.x)
                               : RowSections::height(diagonal, at(east, square.se, square.ne), units.x);
}

}  // namespace itin::viewshed
