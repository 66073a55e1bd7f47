#include <algorithm>
#include <cmath>

#include "cell_blocks.hpp"
#include "group_survey.hpp"

namespace itin::viewshed {

namespace {

DemandSet cells_in_reach(const RasterGrid& grid, Point2 p, double radius) {
  const CellBlocks blocks(grid);
  constexpr std::int64_t kSide = CellBlocks::kSide;
  const auto clamp = [](double v, std::int64_t count) {
    return std::clamp<std::int64_t>(static_cast<std::int64_t>(std::floor(v)), 0, count - 1);
  };
  const std::int64_t west = clamp(grid.column_at(p.x - radius) - 1, grid.columns()) / kSide,
                     east = clamp(grid.column_at(p.x + radius) + 1, grid.columns()) / kSide,
                     north = clamp(grid.row_at(p.y + radius) - 1, grid.rows()) / kSide,
                     south = clamp(grid.row_at(p.y - radius) + 1, grid.rows()) / kSide;
  DemandSet set;
  for (std::int64_t row = north; row <= south; ++row) {
    for (std::int64_t column = west; column <= east; ++column) {
      std::uint64_t members = 0;
      for (std::int64_t r = row * kSide; r < std::min((row + 1) * kSide, grid.rows()); ++r) {
        for (std::int64_t c = column * kSide; c < std::min((column + 1) * kSide, grid.columns()); ++c) {
          const double dx = grid.centre_x(c) - p.x, dy = grid.centre_y(r) - p.y;
          if (dx * dx + dy * dy <= radius * radius) members |= std::uint64_t{1} << CellBlocks::bit({c, r});
        }
      }
      set.add(blocks.block({column * kSide, row * kSide}), members);
    }
  }
  return set;
}

DemandSet points_in_reach(const std::vector<Point2>& points, Point2 p, double radius) {
  DemandSet set;
  for (std::size_t first = 0; first < points.size(); first += 64) {
    std::uint64_t members = 0;
    for (std::size_t i = first; i < std::min(points.size(), first + 64); ++i) {
      const double dx = points[i].x - p.x, dy = points[i].y - p.y;
      if (dx * dx + dy * dy <= radius * radius) members |= std::uint64_t{1} << (i - first);
    }
    set.add(static_cast<std::uint32_t>(first / 64), members);
  }
  return set;
}

}  // namespace

DemandSet within_reach(const SiteSurvey& survey, const SiteStand& stand) {
  return survey.targets.grid ? cells_in_reach(*survey.targets.grid, stand.position, survey.radius)
                             : points_in_reach(survey.targets.points, stand.position, survey.radius);
}

}  // namespace itin::viewshed
