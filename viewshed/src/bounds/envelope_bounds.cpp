#include "bounds/envelope_bounds.hpp"

#include <algorithm>
#include <cmath>

#include <itin/parallel.hpp>

#include "bounds/feature_margin.hpp"
#include "bounds/triangle_slope.hpp"
#include "line/cell_tiles.hpp"
#include "line/rounded_outwards.hpp"

namespace itin::viewshed {

namespace {

RasterGrid bins_over_box(const Box& box, double bin) {
  if (box.empty()) return {{0, 0}, bin, bin, 1, 1};
  return bins_over({box.xmin, box.ymax}, box.width(), box.height(), bin);
}

}  // namespace

double side_of_bins(const Tin& level, const Box& box) {
  constexpr double kBinsPerTriangle = 64, kMostBins = 1 << 21;
  const double triangles = static_cast<double>(level.triangles.size()) + 1;
  const double side = std::sqrt(box.width() * box.height() / std::min(kMostBins, kBinsPerTriangle * triangles));
  return std::max(side, level.grid.resolution);
}

EnvelopeBounds::EnvelopeBounds(const Tin& lower, const Tin& upper, const std::vector<BoundaryEdge>& outline,
                               const Box& box, double bin)
    : BinBounds(lower.grid, bins_over_box(box, bin)),
      low_(grid_.cell_count(), kFloatInfinity),
      high_(grid_.cell_count(), -kFloatInfinity) {
  std::int32_t lowest = 0, highest = 0;
  for (const Tin* const tin : {&lower, &upper})
    for (const GridPoint& v : tin->vertices) lowest = std::min(lowest, v.z), highest = std::max(highest, v.z);
  greatest_magnitude_ = std::max(-static_cast<double>(lowest), static_cast<double>(highest));
  bound(lower, upper);
  lower_along_outline(lower, outline);
  round_outwards();
  bound_runs();
}

/// The slack about triangles, in bins.
double EnvelopeBounds::slack() const {
  return std::max(1e-6, kStepsBeside / bin_size());
}

/// Works in tiles of bins, each by one thread.
void EnvelopeBounds::bound(const Tin& lower, const Tin& upper) {
  const RasterGrid tiles = grid_of_tiles(grid_);
  const TriangleBins triangles(lower, tiles);
  const VerticesInBins vertices(lower, grid_);
  parallel_for(tiles.cell_count(), [&](std::size_t i) {
    const Tile tile = tile_at(grid_, tiles, i);
    const BinRange within{tile.column, tile.column + tile.columns - 1, tile.row, tile.row + tile.rows - 1};
    for (const std::uint32_t t : triangles.triangles(i)) bound_triangle(lower, upper, vertices, t, within);
  });
}

void EnvelopeBounds::bound_triangle(const Tin& lower, const Tin& upper, const VerticesInBins& vertices,
                                    std::uint32_t triangle, const BinRange& within) {
  const TriangleInBins in_bins(vertices, lower.triangles[triangle], slack());
  const double half = bin_size() / 2 + kStepsBeside;
  const TriangleSlope low(lower, triangle, half), high(upper, triangle, half);
  for (std::int64_t row = std::max(in_bins.box().north, within.north);
       row <= std::min(in_bins.box().south, within.south); ++row) {
    const auto [first, last] = in_bins.columns_in(row);
    const double y = (grid_.centre_y(row) - units_.origin.y) / units_.resolution;
    for (std::int64_t column = std::max(first, within.west); column <= std::min(last, within.east); ++column) {
      const double x = (grid_.centre_x(column) - units_.origin.x) / units_.resolution;
      const std::size_t bin = grid_.index({column, row});
      low_[bin] = std::min(low_[bin], static_cast<float>(low.low(low.middle(x, y)) - kStepsUp));
      high_[bin] = std::max(high_[bin], static_cast<float>(high.high(high.middle(x, y)) + kStepsUp));
    }
  }
}

/// A bin that a triangle meets and the outline does not is covered throughout; elsewhere nothing is known of how low
/// the ground is.
void EnvelopeBounds::lower_along_outline(const Tin& tin, const std::vector<BoundaryEdge>& outline) {
  const VerticesInBins vertices(tin, grid_);
  for (const BoundaryEdge& edge : outline) {
    const TriangleInBins in_bins(vertices, {edge.from, edge.to, edge.to}, slack());
    for (std::int64_t row = in_bins.box().north; row <= in_bins.box().south; ++row) {
      const auto [first, last] = in_bins.columns_in(row);
      for (std::int64_t column = first; column <= last; ++column) low_[grid_.index({column, row})] = -kFloatInfinity;
    }
  }
}

/// Rounds outwards what was rounded to the nearest float before. Nothing is known of how low the ground is in bins that
/// no triangle meets.
void EnvelopeBounds::round_outwards() {
  parallel_for(static_cast<std::size_t>(rows()), [&](std::size_t row) {
    for (std::int64_t column = 0; column < columns(); ++column) {
      const std::size_t bin = grid_.index({column, static_cast<std::int64_t>(row)});
      float &low = low_[bin], &high = high_[bin];
      low = low == kFloatInfinity ? -kFloatInfinity : std::nextafter(low, -kFloatInfinity);
      if (high != -kFloatInfinity) high = std::nextafter(high, kFloatInfinity);
    }
  });
}

void EnvelopeBounds::bound_runs() {
  const auto range_of = [&](std::int64_t column, std::int64_t row) {
    const std::size_t bin = grid_.index({column, row});
    return RunBounds::Range<float>{low_[bin], high_[bin]};
  };
  const auto same = [](float z) { return z; };
  parallel_for(runs_.tile_count(), [&](std::size_t tile) { runs_.bound<float>(tile, range_of, same, same); });
}

float EnvelopeBounds::highest(const BinBox& box) const {
  const BinRange bins = bins_about(box);
  const auto first = std::max<std::int64_t>(0, bins.west), end = std::min(bins.east + 1, columns());
  float highest = -kFloatInfinity;
  for (auto row = std::max<std::int64_t>(0, bins.north); row <= std::min(bins.south, rows() - 1); ++row) {
    const float* const of_row = high_.data() + row * columns();
    for (auto column = first; column < end; ++column) highest = std::max(highest, of_row[column]);
  }
  return highest;
}

bool EnvelopeBounds::covers(const BinBox& box) const {
  const BinRange bins = bins_about(box);
  if (bins.west < 0 || bins.north < 0 || bins.east >= columns() || bins.south >= rows()) return false;
  for (auto row = bins.north; row <= bins.south; ++row) {
    const float* const of_row = low_.data() + row * columns();
    if (std::any_of(of_row + bins.west, of_row + bins.east + 1, [](float low) { return low == -kFloatInfinity; }))
      return false;
  }
  return true;
}

}  // namespace itin::viewshed
