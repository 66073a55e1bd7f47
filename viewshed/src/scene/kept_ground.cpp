#include "scene/kept_ground.hpp"

#include <algorithm>
#include <cmath>

#include <itin/grid_units.hpp>
#include <itin/sort_unique.hpp>
#include <itin/tin_heights.hpp>

#include "bounds/surface_heights.hpp"

namespace itin::viewshed {

namespace {

std::int64_t tile_of(std::int64_t cell) {
  return cell >= 0 ? cell / Tile::kSide : -((Tile::kSide - 1 - cell) / Tile::kSide);
}

/// The cells of a tile that is kept.
RasterGrid grid_of_tile(const GroundCache::Key& key) {
  constexpr auto kSide = static_cast<double>(Tile::kSide);
  return {{static_cast<double>(key.column) * kSide * key.cell_width,
           static_cast<double>(key.row + 1) * kSide * key.cell_height},
          key.cell_width,
          key.cell_height,
          Tile::kSide,
          Tile::kSide};
}

constexpr Tile kWholeTile{0, 0, Tile::kSide, Tile::kSide};

/// Calls visit(first, kept, count, tile) for each run of `count` cells from number `from` on that lie in one tile:
/// cells `first` and after of the run are cells `kept` and after of the tile.
template <class Visit>
void for_each_run(std::int64_t from, std::int64_t count, const Visit& visit) {
  for (std::int64_t first = 0; first < count;) {
    const std::int64_t tile = tile_of(from + first), kept = from + first - tile * Tile::kSide;
    const std::int64_t run = std::min(count - first, Tile::kSide - kept);
    visit(first, kept, run, tile);
    first += run;
  }
}

}  // namespace

KeptGround::KeptGround(std::shared_ptr<const BinnedHeights> heights, const Tin* surface,
                       std::shared_ptr<GroundCache> cache)
    : heights_(std::move(heights)),
      surface_(surface),
      units_(heights_->units()),
      bin_side_(heights_->bin_size() * units_.resolution),
      cache_(std::move(cache)),
      number_(cache_->new_surface()) {}

KeptGround::KeptGround(const Tin& surface, std::shared_ptr<GroundCache> cache)
    : surface_(&surface),
      bins_(surface),
      units_(surface.grid),
      bin_side_(bins_->grid.cell_width()),
      cache_(std::move(cache)),
      number_(cache_->new_surface()) {}

void KeptGround::find(const RasterGrid& grid, const Tile& tile, const TileCentres& at,
                      TileValues<double>& ground) const {
  ground.fill(kNoSurface);
  const std::vector<Share> all = shares(grid, tile);
  if (!std::all_of(all.begin(), all.end(), [&](const Share& share) { return holds_centres(share, at); }))
    return measure(tile, at, grid.cell_width() * static_cast<double>(tile.step), ground);
  for (const Share& share : all) {
    const GroundCache::Heights heights = kept(share.key);
    for (std::int64_t r = 0; r < share.rows; ++r)
      std::copy_n(heights->data() + (share.kept_row + r) * Tile::kSide + share.kept_column, share.columns,
                  ground.data() + (share.row + r) * Tile::kSide + share.column);
  }
}

std::vector<KeptGround::Share> KeptGround::shares(const RasterGrid& grid, const Tile& tile) const {
  const auto step = static_cast<double>(tile.step);
  const double width = grid.cell_width() * step, height = grid.cell_height() * step;
  const auto west = static_cast<std::int64_t>(std::floor(grid.centre_x(tile.column) / width)),
             // Rows count southwards.
      north = -1 - static_cast<std::int64_t>(std::floor(grid.centre_y(tile.row) / height));
  std::vector<Share> all;
  for_each_run(north, tile.rows, [&](std::int64_t row, std::int64_t kept_row, std::int64_t rows, std::int64_t south) {
    for_each_run(west, tile.columns,
                 [&](std::int64_t column, std::int64_t kept_column, std::int64_t columns, std::int64_t east) {
                   all.push_back(
                       {{number_, width, height, east, -1 - south}, column, row, kept_column, kept_row, columns, rows});
                 });
  });
  return all;
}

/// Tells whether cells have their centres where the kept ones have them, to the last bit.
bool KeptGround::holds_centres(const Share& share, const TileCentres& at) const {
  const TileCentres kept(units_, grid_of_tile(share.key), kWholeTile);
  const auto same = [](const auto& a, std::int64_t from_a, const auto& b, std::int64_t from_b, std::int64_t count) {
    return std::equal(a.begin() + from_a, a.begin() + from_a + count, b.begin() + from_b);
  };
  return same(at.x, share.column, kept.x, share.kept_column, share.columns) &&
         same(at.y, share.row, kept.y, share.kept_row, share.rows);
}

GroundCache::Heights KeptGround::kept(const GroundCache::Key& key) const {
  return cache_->get(key, [&] {
    const auto heights = std::make_shared<TileValues<double>>();
    heights->fill(kNoSurface);
    measure(kWholeTile, TileCentres(units_, grid_of_tile(key), kWholeTile), key.cell_width, *heights);
    return heights;
  });
}

/// Measures triangle by triangle where cells are much smaller than these, and else cell by cell.
void KeptGround::measure(const Tile& tile, const TileCentres& at, double cell_width, TileValues<double>& ground) const {
  if (surface_ != nullptr && !(heights_ && heights_->partition()) && 2 * cell_width < bin_side_)
    return scan_convert(*surface_, triangles_about(tile, at), tile, at, ground);
  const auto columns = static_cast<std::size_t>(tile.columns), rows = static_cast<std::size_t>(tile.rows);
  if (heights_ && heights_->expanse(at.at(0), {at.x[columns - 1], at.y[rows - 1]}) == BinnedHeights::Expanse::kAllBare)
    return;
  for_each_cell(tile, [&](std::size_t cell, RasterGrid::Cell) {
    if (const auto height = height_at(at.at(cell))) ground[cell] = *height;
  });
}

std::optional<double> KeptGround::height_at(Point2 units) const {
  if (heights_) return heights_->height_at(units);
  const auto bin = bins_->grid.cell_at(place_in_metres(units_, units));
  if (!bin) return std::nullopt;
  return height_over(*surface_, bins_->triangles.triangles(bins_->grid.index(*bin)), units);
}

/// Lists the triangles that may hold the tile's centres, ascending.
std::vector<std::uint32_t> KeptGround::triangles_about(const Tile& tile, const TileCentres& at) const {
  const auto east = static_cast<std::size_t>(tile.columns - 1), south = static_cast<std::size_t>(tile.rows - 1);
  const RasterGrid& grid = bins_ ? bins_->grid : heights_->grid();
  const Point2 north_west = place_in_metres(units_, at.at(0)),
               south_east = place_in_metres(units_, {at.x[east], at.y[south]});
  const auto bin = [](double v, std::int64_t count) {
    return std::clamp<std::int64_t>(static_cast<std::int64_t>(std::floor(v)), 0, count - 1);
  };
  constexpr double kHair = 1e-6;
  const std::int64_t last_row = bin(grid.row_at(south_east.y) + kHair, grid.rows()),
                     last_column = bin(grid.column_at(south_east.x) + kHair, grid.columns());
  std::vector<std::uint32_t> triangles;
  for (std::int64_t r = bin(grid.row_at(north_west.y) - kHair, grid.rows()); r <= last_row; ++r) {
    for (std::int64_t c = bin(grid.column_at(north_west.x) - kHair, grid.columns()); c <= last_column; ++c) {
      const auto listed = bins_ ? bins_->triangles.triangles(grid.index({c, r})) : heights_->triangles({c, r});
      triangles.insert(triangles.end(), listed.begin(), listed.end());
    }
  }
  sort_unique(triangles);
  return triangles;
}

}  // namespace itin::viewshed
