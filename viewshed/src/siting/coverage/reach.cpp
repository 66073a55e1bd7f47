#include <algorithm>
#include <cmath>
#include <numbers>

#include <itin/call_progress.hpp>
#include <itin/parallel.hpp>
#include <viewshed/site_coverage.hpp>

#include "bounds/surface_heights.hpp"
#include "bounds/triangle_bins.hpp"
#include "siting/coverage/cell_blocks.hpp"
#include "siting/coverage/point_bins.hpp"
#include "window/retrieval.hpp"

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

DemandSet within_reach(const SiteTargets& targets, Point2 position, double radius) {
  return targets.grid ? cells_in_reach(*targets.grid, position, radius)
                      : points_in_reach(targets.points, position, radius);
}

namespace {

/// Counts the blocks of cells or points that may lie within a radius, more rather than fewer.
double blocks_in_reach(const SiteTargets& targets, double radius) {
  if (!targets.grid) return std::ceil(static_cast<double>(targets.points.size()) / 64);
  const RasterGrid& grid = *targets.grid;
  constexpr double kSide = CellBlocks::kSide;
  // Blocks that meet a disc lie within one that is a block's diagonal wider.
  const double columns = radius / (kSide * grid.cell_width()) + std::sqrt(2),
               rows = radius / (kSide * grid.cell_height()) + std::sqrt(2);
  return std::min(std::numbers::pi * columns * rows, static_cast<double>(CellBlocks(grid).count()));
}

}  // namespace

/// Bounds from above and from below, now and after the first look.
std::uint64_t bytes_of_coverage(const SiteSurvey& survey) {
  constexpr double kSets = 4;
  const double of_set = sizeof(DemandSet::Block) * std::ceil(blocks_in_reach(survey.targets, survey.radius));
  return static_cast<std::uint64_t>(kSets * of_set * static_cast<double>(survey.positions.size()));
}

namespace {

DemandSet cells_with_ground(const Store& store, const RasterGrid& grid, Progress& progress) {
  const Tin tin = coverage_of(store, Window::box(grid.bounds()), progress);
  const RasterGrid tiles = grid_of_tiles(grid);
  const TriangleBins bins(tin, tiles);
  const CellBlocks blocks(grid);
  std::vector<std::uint64_t> members(blocks.count());
  parallel_for(tiles.cell_count(), [&](std::size_t t) {
    const Tile tile = tile_at(grid, tiles, t);
    const auto heights = std::make_unique<TileValues<double>>();
    scan_convert(tin, bins.triangles(t), tile, TileCentres(tin.grid, grid, tile), *heights);
    for_each_cell(tile, [&](std::size_t cell, RasterGrid::Cell place) {
      if (!std::isnan((*heights)[cell])) members[blocks.block(place)] |= std::uint64_t{1} << CellBlocks::bit(place);
    });
  });
  DemandSet set;
  for (std::size_t b = 0; b < members.size(); ++b) set.add(static_cast<std::uint32_t>(b), members[b]);
  return set;
}

DemandSet points_with_ground(const Store& store, const std::vector<Point2>& points, Progress& progress) {
  const RasterGrid bins_grid = bins_of_points(points);
  const Tin tin = coverage_of(store, Window::box(bins_grid.bounds()), progress);
  const TriangleBins bins(tin, bins_grid);
  DemandSet set;
  for (std::size_t first = 0; first < points.size(); first += 64) {
    std::uint64_t members = 0;
    for (std::size_t i = first; i < std::min(points.size(), first + 64); ++i) {
      const auto bin = bins_grid.cell_at(points[i]);
      if (bin && surface_height(tin, bins.triangles(bins_grid.index(*bin)), points[i]))
        members |= std::uint64_t{1} << (i - first);
    }
    set.add(static_cast<std::uint32_t>(first / 64), members);
  }
  return set;
}

}  // namespace

DemandSet with_ground(const Store& store, const SiteTargets& targets, Progress& progress) {
  CallProgress call(progress);
  DemandSet set =
      targets.grid ? cells_with_ground(store, *targets.grid, call) : points_with_ground(store, targets.points, call);
  call.finish();
  return set;
}

}  // namespace itin::viewshed
