#include "plan/ground_tiles.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <itin/parallel.hpp>

#include "line/cell_tiles.hpp"

namespace itin::viewshed {

namespace {

constexpr double kMostTilesPerSide = 160;

RasterGrid tiles_over(const Store& store, int level, const Box& box, double points_of_tile) {
  const double points = static_cast<double>(store.points_about(level, box));
  const double side = std::max({box.width(), box.height(), store.metadata().grid.resolution});
  const double tiles = std::clamp(std::sqrt(points / points_of_tile), 1.0, kMostTilesPerSide);
  const double size = side * 1.0001 / tiles;
  return {{box.xmin, box.ymax},
          size,
          size,
          static_cast<std::int64_t>(std::floor(box.width() / size)) + 1,
          static_cast<std::int64_t>(std::floor(box.height() / size)) + 1};
}

}  // namespace

bool TileSet::empty() const {
  return std::all_of(words_.begin(), words_.end(), [](std::uint64_t w) { return w == 0; });
}

TileSet& TileSet::operator|=(const TileSet& other) {
  for (std::size_t w = 0; w < words_.size(); ++w) words_[w] |= other.words_[w];
  return *this;
}

TileSet& TileSet::operator&=(const TileSet& other) {
  for (std::size_t w = 0; w < words_.size(); ++w) words_[w] &= other.words_[w];
  return *this;
}

GroundTiles::GroundTiles(const Store& store, int level, const Box& box, double points_of_tile)
    : grid_(tiles_over(store, level, box, points_of_tile)),
      margin_(1 + store.metadata().grid.resolution),
      points_(grid_.cell_count()) {
  parallel_for(points_.size(), [&](std::size_t tile) {
    points_[tile] = static_cast<std::uint32_t>(store.points_about(level, this->box(tile)));
  });
}

Box GroundTiles::box(std::size_t tile) const {
  return box_of_cell(grid_, place_of(grid_, tile));
}

std::uint64_t GroundTiles::points(const TileSet& tiles) const {
  std::uint64_t sum = 0;
  tiles.for_each([&](std::size_t tile) { sum += points_[tile]; });
  return sum;
}

TileSet GroundTiles::those(const std::function<bool(const Box&)>& test) const {
  std::vector<std::uint8_t> holds(count());
  parallel_for(holds.size(), [&](std::size_t tile) { holds[tile] = test(box(tile)) ? 1 : 0; });
  TileSet result(count());
  for (std::size_t tile = 0; tile < holds.size(); ++tile)
    if (holds[tile] != 0) result.add(tile);
  return result;
}

/// Calls visit(column, first row, last row) for the tiles of each column about the line.
template <class Visit>
void GroundTiles::for_each_column(Point2 from, Point2 to, const Visit& visit) const {
  const double margin = margin_ / grid_.cell_width();
  double c0 = grid_.column_at(from.x), r0 = grid_.row_at(from.y), c1 = grid_.column_at(to.x), r1 = grid_.row_at(to.y);
  if (c1 < c0) std::swap(c0, c1), std::swap(r0, r1);
  const auto clamp = [](double v, std::int64_t n) {
    return static_cast<std::int64_t>(std::clamp(std::floor(v), 0.0, static_cast<double>(n - 1)));
  };
  const double slope = c1 > c0 ? (r1 - r0) / (c1 - c0) : 0;
  for (std::int64_t column = clamp(c0 - margin, grid_.columns()); column <= clamp(c1 + margin, grid_.columns());
       ++column) {
    // The part of the line over the column, widened.
    const double west = std::clamp(static_cast<double>(column) - margin, c0, c1);
    const double east = std::clamp(static_cast<double>(column + 1) + margin, c0, c1);
    const double a = c1 > c0 ? r0 + slope * (west - c0) : r0, b = c1 > c0 ? r0 + slope * (east - c0) : r1;
    visit(column, clamp(std::min(a, b) - margin, grid_.rows()), clamp(std::max(a, b) + margin, grid_.rows()));
  }
}

void GroundTiles::add_line(Point2 from, Point2 to, TileSet& tiles) const {
  for_each_column(from, to, [&](std::int64_t column, std::int64_t first, std::int64_t last) {
    for (std::int64_t row = first; row <= last; ++row) tiles.add(grid_.index({column, row}));
  });
}

void GroundTiles::add_lines(Point2 from, const Box& to, TileSet& tiles) const {
  // The lines fill a convex area; in each column its tiles lie between those of its edges.
  struct Rows {
    std::int64_t first = std::numeric_limits<std::int64_t>::max(), last = -1;
  };
  std::vector<Rows> rows(static_cast<std::size_t>(grid_.columns()));
  const auto add_edge = [&](Point2 a, Point2 b) {
    for_each_column(a, b, [&](std::int64_t column, std::int64_t first, std::int64_t last) {
      Rows& r = rows[static_cast<std::size_t>(column)];
      r = {std::min(r.first, first), std::max(r.last, last)};
    });
  };
  const std::array<Point2, 4> corners{{{to.xmin, to.ymin}, {to.xmax, to.ymin}, {to.xmax, to.ymax}, {to.xmin, to.ymax}}};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    add_edge(from, corners[i]);
    add_edge(corners[i], corners[(i + 1) % corners.size()]);
  }
  for (std::int64_t column = 0; column < grid_.columns(); ++column)
    for (std::int64_t row = rows[static_cast<std::size_t>(column)].first;
         row <= rows[static_cast<std::size_t>(column)].last; ++row)
      tiles.add(grid_.index({column, row}));
}

Window GroundTiles::window(const TileSet& tiles) const {
  // Runs down each column make fewer parts.
  std::vector<Window::Polygon> parts;
  for (std::int64_t column = 0; column < grid_.columns(); ++column) {
    for (std::int64_t row = 0; row < grid_.rows(); ++row) {
      if (!tiles.contains(grid_.index({column, row}))) continue;
      const std::int64_t first = row;
      while (row < grid_.rows() && tiles.contains(grid_.index({column, row}))) ++row;
      Box b = box_of_cell(grid_, {column, first});
      b.extend(box_of_cell(grid_, {column, row - 1}));
      parts.push_back(Window::rectangle(b));
    }
  }
  return Window::polygons(std::move(parts));
}

}  // namespace itin::viewshed
