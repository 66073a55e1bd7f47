#include "bounds/pixel_heights.hpp"

#include <cmath>
#include <limits>

#include <itin/grid_units.hpp>
#include <itin/lattice_tin.hpp>
#include <itin/parallel.hpp>

#include "bounds/surface_heights.hpp"
#include "bounds/triangle_bins.hpp"

namespace itin::viewshed {

namespace {

/// The lattice's height at a position, both in grid units.
double height_at(const LatticeTin& lattice, double x, double y) {
  const double column = std::floor((x - lattice.west) / lattice.spacing),
               row = std::floor((lattice.north - y) / lattice.spacing);
  double height = kNoSurface;
  if (!(column >= 0 && row >= 0 && column < lattice.columns && row < lattice.rows)) return height;
  lattice.for_each_triangle(lattice.cell(static_cast<std::uint32_t>(column), static_cast<std::uint32_t>(row)),
                            [&](std::uint32_t t) {
                              const auto found = height_over(lattice.corners(t), {x, y});
                              if (found) height = *found;
                              return !found;
                            });
  return height;
}

}  // namespace

std::vector<float> heights_at(const Tin& tin, const RasterGrid& pixels) {
  std::vector<float> heights(pixels.cell_count());
  const RasterGrid tiles = grid_of_tiles(pixels);
  const TriangleBins bins(tin, tiles);
  parallel_for(tiles.cell_count(), [&](std::size_t i) {
    const Tile tile = tile_at(pixels, tiles, i);
    TileValues<double> values;
    scan_convert(tin, bins.triangles(i), tile, TileCentres(tin.grid, pixels, tile), values);
    for_each_cell(tile, [&](std::size_t cell, RasterGrid::Cell place) {
      heights[pixels.index(place)] = static_cast<float>(values[cell] * tin.grid.resolution);
    });
  });
  return heights;
}

std::vector<float> heights_at(const LatticeTin& lattice, const RasterGrid& pixels) {
  std::vector<float> heights(pixels.cell_count());
  parallel_for(static_cast<std::size_t>(pixels.rows()), [&](std::size_t row) {
    const auto r = static_cast<std::int64_t>(row);
    const double y = northing_in_units(lattice.grid, pixels.centre_y(r));
    for (std::int64_t c = 0; c < pixels.columns(); ++c)
      heights[pixels.index({c, r})] = static_cast<float>(
          height_at(lattice, easting_in_units(lattice.grid, pixels.centre_x(c)), y) * lattice.grid.resolution);
  });
  return heights;
}

}  // namespace itin::viewshed
