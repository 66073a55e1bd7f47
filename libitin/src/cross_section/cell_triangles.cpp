#include "cross_section/cell_triangles.hpp"

#include <algorithm>
#include <cstdlib>
#include <utility>

#include "geometry/whole_division.hpp"

namespace itin {

namespace {

/// Returns the first and the last cell that meet the interval from `low` to `high`, by their lower borders.
std::pair<std::int64_t, std::int64_t> cells_meeting(std::int64_t low, std::int64_t high, std::int64_t origin,
                                                    std::int64_t side) {
  const auto floored = [&](std::int64_t v) { return origin + floor_divide(v - origin, side) * side; };
  return {floored(low - 1), floored(high)};
}

}  // namespace

std::optional<SectionVertex> CellTriangles::beyond(Position a, Position b) {
  const std::int64_t dx = std::int64_t{b.x} - a.x, dy = std::int64_t{b.y} - a.y;
  const bool diagonal = dx == -dy;
  if (dx != 0 && dy != 0 && !diagonal) return std::nullopt;
  // The cell lies to the left of ab where that is one of its sides, and about ab where that is its diagonal.
  LatticeCell cell{std::min(a.x, b.x), std::min(a.y, b.y), std::max(std::abs(dx), std::abs(dy))};
  if (cell.side == 0) return std::nullopt;
  if (dx == 0 && dy > 0) cell.x -= cell.side;
  if (dy == 0 && dx < 0) cell.y -= cell.side;
  const LatticeSheet* sheet = sheet_of(cell);
  if (sheet == nullptr) return std::nullopt;
  const auto post = [&](std::int64_t x, std::int64_t y) { return SectionVertex{sheet->post(x, y), 0}; };
  if (diagonal) return dx > 0 ? post(cell.x + cell.side, cell.y + cell.side) : post(cell.x, cell.y);
  const auto is_upper_left = [&](Position p) { return p.x == cell.x && p.y == cell.y + cell.side; };
  if (is_upper_left(a) || is_upper_left(b)) return post(cell.x + cell.side, cell.y);
  return post(cell.x, cell.y + cell.side);
}

std::vector<std::array<SectionVertex, 3>> CellTriangles::around(const GridBox& box) {
  const std::optional<LatticeCell> any = cell_about(box);
  if (!any) return {};
  const std::int64_t side = any->side;
  const auto [west, east] = cells_meeting(box.xmin, box.xmax, any->x, side);
  const auto [south, north] = cells_meeting(box.ymin, box.ymax, any->y, side);
  std::vector<std::array<SectionVertex, 3>> triangles;
  for (std::int64_t y = south; y <= north; y += side) {
    for (std::int64_t x = west; x <= east; x += side) {
      const LatticeSheet* sheet = sheet_of({x, y, side});
      if (sheet == nullptr) return {};
      const auto post = [&](std::int64_t u, std::int64_t v) { return SectionVertex{sheet->post(u, v), 0}; };
      const SectionVertex lower_right = post(x + side, y), upper_left = post(x, y + side);
      triangles.push_back({post(x, y), lower_right, upper_left});
      triangles.push_back({lower_right, post(x + side, y + side), upper_left});
    }
  }
  return triangles;
}

}  // namespace itin
