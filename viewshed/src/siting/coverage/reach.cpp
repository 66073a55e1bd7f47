#include <algorithm>
#include <cmath>
#include <numbers>

#include <itin/call_progress.hpp>
#include <viewshed/site_coverage.hpp>

#include "siting/coverage/demand_blocks.hpp"
#include "siting/coverage/point_bins.hpp"
#include "siting/coverage/target_ground.hpp"
#include "window/retrieval.hpp"

namespace itin::viewshed {

namespace {

DemandSet cells_in_reach(const RasterGrid& grid, Point2 p, double radius) {
  const DemandBlocks blocks(grid);
  constexpr std::int64_t kSide = DemandBlocks::kSide;
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
          if (dx * dx + dy * dy <= radius * radius) members |= std::uint64_t{1} << DemandBlocks::bit({c, r});
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

DemandSet within_reach(const SiteTargets& targets, Point2 position, double radius) {
  return targets.grid ? cells_in_reach(*targets.grid, position, radius)
                      : points_in_reach(targets.points, position, radius);
}

std::size_t element_count(const SiteTargets& targets) {
  if (targets.grid) return element_count(*targets.grid);
  return targets.elements.empty() ? targets.points.size() : std::size_t{targets.elements.back()} + 1;
}

namespace {

std::size_t cells_or_points(const SiteTargets& targets) {
  return targets.grid ? element_count(*targets.grid) : targets.points.size();
}

/// Makes a set from the members of each block.
DemandSet set_of_words(const std::vector<std::uint64_t>& words) {
  DemandSet set;
  for (std::size_t b = 0; b < words.size(); ++b) set.add(static_cast<std::uint32_t>(b), words[b]);
  return set;
}

}  // namespace

DemandSet within_reach(const SiteTargets& targets, std::span<const SitePosition> sites, double radius) {
  std::vector<std::uint64_t> members((cells_or_points(targets) + 63) / 64);
  for (std::size_t i = 0; i < sites.size(); ++i) {
    if (i > 0 && sites[i].position == sites[i - 1].position) continue;  // another mast at the same place
    const DemandSet of_site = within_reach(targets, sites[i].position, radius);
    for (const DemandSet::Block& block : of_site.blocks()) members[block.number] |= block.members;
  }
  return set_of_words(members);
}

namespace {

/// Counts the blocks of cells or points that may lie within a radius, more rather than fewer.
double blocks_in_reach(const SiteTargets& targets, double radius) {
  if (!targets.grid) return std::ceil(static_cast<double>(targets.points.size()) / 64);
  const RasterGrid& grid = *targets.grid;
  constexpr double kSide = DemandBlocks::kSide;
  // Blocks that meet a disc lie within one that is a block's diagonal wider.
  const double columns = radius / (kSide * grid.cell_width()) + std::sqrt(2),
               rows = radius / (kSide * grid.cell_height()) + std::sqrt(2);
  return std::min(std::numbers::pi * columns * rows, static_cast<double>(DemandBlocks(grid).count()));
}

}  // namespace

/// Counts four sets per site: bounds from above and from below, now and after the first stage.
std::uint64_t bytes_of_coverage(const SiteSurvey& survey) {
  constexpr double kSets = 4;
  const double of_set = sizeof(DemandSet::Block) * std::ceil(blocks_in_reach(survey.targets, survey.radius));
  return static_cast<std::uint64_t>(kSets * of_set * static_cast<double>(survey.positions.size()));
}

namespace {

DemandSet cells_with_ground(const Tin& ground, const RasterGrid& grid) {
  const DemandBlocks blocks(grid);
  std::vector<std::uint64_t> members(blocks.count());
  for_each_tile_on(ground, grid, [&](const Tile& tile, const TileValues<double>& heights) {
    for_each_cell(tile, [&](std::size_t cell, RasterGrid::Cell place) {
      if (!std::isnan(heights[cell])) members[blocks.block(place)] |= std::uint64_t{1} << DemandBlocks::bit(place);
    });
  });
  return set_of_words(members);
}

DemandSet points_with_ground(const Tin& ground, const std::vector<Point2>& points) {
  std::vector<std::uint64_t> members((points.size() + 63) / 64);
  for_each_point_on(ground, points,
                    [&](std::size_t point, double) { members[point / 64] |= std::uint64_t{1} << point % 64; });
  return set_of_words(members);
}

}  // namespace

DemandSet with_ground(const Store& store, const SiteTargets& targets, Progress& progress) {
  const Box box = targets.grid ? targets.grid->bounds() : bins_of_points(targets.points).bounds();
  CallProgress call(progress);
  const Tin ground = coverage_of(store, Window::box(box), call);
  DemandSet set = targets.grid ? cells_with_ground(ground, *targets.grid) : points_with_ground(ground, targets.points);
  call.finish();
  return set;
}

}  // namespace itin::viewshed
