#include "bounds/surface_bins.hpp"

#include <algorithm>
#include <cmath>

#include <itin/parallel.hpp>

#include "bounds/triangle_bins.hpp"
#include "bounds/triangle_in_bins.hpp"
#include "bounds/triangle_slope.hpp"
#include "line/rounded_outwards.hpp"

namespace itin::viewshed {

namespace {

/// A margin in grid units, greater than all rounding of heights and than a grazing.
constexpr double kRoundingMargin = 0.01;
/// The least rise within a bin, metres, of a thing that stands there.
constexpr double kThing = 0.5;

constexpr SurfaceBins::Range kBounded{kFloatInfinity, -kFloatInfinity};

/// Calls visit(bin, low, high) for the bins of a grid among those given that a triangle meets.
template <class Visit>
void for_each_bin_under(const Tin& tin, const VerticesInBins& vertices, std::uint32_t triangle, const RasterGrid& bins,
                        const BinRange& within, const Visit& visit) {
  const TriangleInBins in_bins(vertices, tin.triangles[triangle]);
  const Grid& units = tin.grid;
  const TriangleSlope slope(tin, triangle, bins.cell_width() / units.resolution / 2);
  for (std::int64_t row = std::max(in_bins.box().north, within.north);
       row <= std::min(in_bins.box().south, within.south); ++row) {
    const auto [first, last] = in_bins.columns_in(row);
    const double y = (bins.centre_y(row) - units.origin.y) / units.resolution;
    for (std::int64_t column = std::max(first, within.west); column <= std::min(last, within.east); ++column) {
      const double middle = slope.middle((bins.centre_x(column) - units.origin.x) / units.resolution, y);
      visit(RasterGrid::Cell{column, row}, slope.low(middle) - kRoundingMargin, slope.high(middle) + kRoundingMargin);
    }
  }
}

void extend(SurfaceBins::Range& range, double low, double high) {
  range.low = std::min(range.low, rounded_down(low)), range.high = std::max(range.high, rounded_up(high));
}

BinRange bins_of(const Tile& tile) {
  return {tile.column, tile.column + tile.columns - 1, tile.row, tile.row + tile.rows - 1};
}

}  // namespace

SurfaceBins::SurfaceBins(const Grid& units, const Box& box, double side, std::size_t most_divided)
    : BinGrid(units, bins_over({box.xmin, box.ymax}, box.width(), box.height(), side)),
      most_divided_(most_divided),
      ranges_(grid_.cell_count(), Range{-kFloatInfinity, -kFloatInfinity}),
      divided_(grid_.cell_count()) {}

void SurfaceBins::add(const Tin& surface, const CellRectangle& tiles) {
  const RasterGrid all = this->tiles(), some = all.part({tiles.column, tiles.row}, tiles.columns, tiles.rows);
  const TriangleBins triangles(surface, some);
  const auto tile = [&](std::size_t i) { return tile_at(grid_, all, all.index(tiles.cell(i))); };
  parallel_for(tiles.count(), [&](std::size_t i) { bound(surface, triangles.triangles(i), tile(i)); });
  const Tile first = tile(0), last = tile(tiles.count() - 1);
  const CellRectangle bins{first.column, first.row, last.column + last.columns - first.column,
                           last.row + last.rows - first.row};
  forget_depth_along(boundary_edges(surface), surface, bins);
  for (std::size_t i = 0; i < bins.count() && parts_.size() < most_divided_; ++i) {
    if (!is_thin(bins.cell(i))) continue;
    Parts& parts = parts_.emplace_back();
    parts.fill(kBounded);
    divided_[grid_.index(bins.cell(i))] = static_cast<std::uint32_t>(parts_.size());
  }
  parallel_for(tiles.count(), [&](std::size_t i) { divide(surface, triangles.triangles(i), tile(i)); });
}

void SurfaceBins::bound(const Tin& surface, std::span<const std::uint32_t> triangles, const Tile& tile) {
  for_each_cell(tile, [&](std::size_t, RasterGrid::Cell bin) { ranges_[grid_.index(bin)] = kBounded; });
  const VerticesInBins vertices(surface, grid_);
  for (const std::uint32_t t : triangles)
    for_each_bin_under(surface, vertices, t, grid_, bins_of(tile), [&](RasterGrid::Cell bin, double low, double high) {
      extend(ranges_[grid_.index(bin)], low, high);
    });
  for_each_cell(tile, [&](std::size_t, RasterGrid::Cell bin) {
    Range& range = ranges_[grid_.index(bin)];
    if (range.low == kFloatInfinity) range.low = -kFloatInfinity;
  });
}

/// A bin that a triangle meets and the outline does not is covered throughout; elsewhere nothing is known of how low
/// the ground is.
void SurfaceBins::forget_depth_along(const std::vector<BoundaryEdge>& outline, const Tin& surface,
                                     const CellRectangle& bins) {
  const VerticesInBins vertices(surface, grid_);
  for (const BoundaryEdge& edge : outline) {
    const TriangleInBins in_bins(vertices, {edge.from, edge.to, edge.to});
    const std::int64_t end = std::min(in_bins.box().south + 1, bins.row + bins.rows);
    for (std::int64_t row = std::max(in_bins.box().north, bins.row); row < end; ++row) {
      const auto [first, last] = in_bins.columns_in(row);
      for (std::int64_t column = std::max(first, bins.column); column <= std::min(last, bins.column + bins.columns - 1);
           ++column)
        ranges_[grid_.index({column, row})].low = -kFloatInfinity;
    }
  }
}

/// Tells whether something rises in the bin, and none of the bins around lies upon it: such a bin would hide as well.
bool SurfaceBins::is_thin(RasterGrid::Cell bin) const {
  const auto [low, high] = range(bin);
  if (low == -kFloatInfinity || (high - low) * units_.resolution < kThing) return false;
  const float half = (low + high) / 2;
  for (std::int64_t row = std::max<std::int64_t>(0, bin.row - 1); row <= std::min(bin.row + 1, rows() - 1); ++row)
    for (std::int64_t column = std::max<std::int64_t>(0, bin.column - 1);
         column <= std::min(bin.column + 1, columns() - 1); ++column)
      if (range({column, row}).low > half) return false;
  return true;
}

void SurfaceBins::divide(const Tin& surface, std::span<const std::uint32_t> triangles, const Tile& tile) {
  const RasterGrid parts(grid_.north_west(), grid_.cell_width() / kParts, grid_.cell_height() / kParts,
                         kParts * columns(), kParts * rows());
  const VerticesInBins vertices(surface, grid_), vertices_in_parts(surface, parts);
  for (const std::uint32_t t : triangles) {
    for_each_bin_under(surface, vertices, t, grid_, bins_of(tile), [&](RasterGrid::Cell bin, double, double) {
      const std::uint32_t number = divided_[grid_.index(bin)];
      if (number == 0) return;
      const RasterGrid::Cell first{kParts * bin.column, kParts * bin.row};
      for_each_bin_under(surface, vertices_in_parts, t, parts,
                         {first.column, first.column + kParts - 1, first.row, first.row + kParts - 1},
                         [&](RasterGrid::Cell part, double low, double high) {
                           const std::int64_t at = (part.row - first.row) * kParts + part.column - first.column;
                           extend(parts_[number - 1][static_cast<std::size_t>(at)], low, high);
                         });
    });
  }
}

}  // namespace itin::viewshed
