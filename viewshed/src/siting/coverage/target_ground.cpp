#include "siting/coverage/target_ground.hpp"

#include <memory>

#include <itin/parallel.hpp>

#include "bounds/surface_heights.hpp"
#include "bounds/triangle_bins.hpp"
#include "siting/coverage/point_bins.hpp"

namespace itin::viewshed {

void for_each_tile_on(const Tin& ground, const RasterGrid& cells,
                      const std::function<void(const Tile& tile, const TileValues<double>& heights)>& visit) {
  const RasterGrid tiles = grid_of_tiles(cells);
  const TriangleBins bins(ground, tiles);
  parallel_for(tiles.cell_count(), [&](std::size_t i) {
    if (bins.triangles(i).empty()) return;
    const Tile tile = tile_at(cells, tiles, i);
    const auto heights = std::make_unique<TileValues<double>>();
    scan_convert(ground, bins.triangles(i), tile, TileCentres(ground.grid, cells, tile), *heights);
    visit(tile, *heights);
  });
}

void for_each_point_on(const Tin& ground, const std::vector<Point2>& points,
                       const std::function<void(std::size_t point, double height)>& visit) {
  const RasterGrid grid = bins_of_points(points);
  const TriangleBins bins(ground, grid);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto bin = grid.cell_at(points[i]);
    if (!bin) continue;
    if (const auto height = surface_height(ground, bins.triangles(grid.index(*bin)), points[i])) visit(i, *height);
  }
}

}  // namespace itin::viewshed
