#include "line/tile_parts.hpp"

#include <map>
#include <utility>

namespace itin::viewshed {

std::size_t cell_count(std::span<const Tile> parts) {
  std::size_t count = 0;
  for (const Tile& part : parts) count += static_cast<std::size_t>(part.columns * part.rows);
  return count;
}

std::vector<PartsOfTile> by_tile(std::span<const Tile> parts, const RasterGrid& tiles) {
  std::map<std::size_t, std::vector<Tile>> of_tiles;
  for (const Tile& part : parts)
    of_tiles[tiles.index({part.column / Tile::kSide, part.row / Tile::kSide})].push_back(part);
  std::vector<PartsOfTile> all;
  for (auto& [tile, some] : of_tiles) all.push_back({tile, std::move(some)});
  return all;
}

std::vector<PartsOfTile> all_cells(const RasterGrid& grid, const RasterGrid& tiles,
                                   std::span<const std::size_t> numbers) {
  std::vector<PartsOfTile> all;
  for (const std::size_t number : numbers) all.push_back({number, {tile_at(grid, tiles, number)}});
  return all;
}

}  // namespace itin::viewshed
