#include "radar_survey.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include <itin/parallel.hpp>

#include "surface_heights.hpp"

namespace itin::viewshed {

namespace {

class RadarTile {
 public:
  RadarTile(const Eye& radar, const Tin& ground, const RasterGrid& grid, const Tile& tile)
      : radar_(radar), units_(ground.grid), grid_(grid), tile_(tile), centres_(ground.grid, grid, tile) {}

  void run(const Tin& ground, std::span<const std::uint32_t> triangles, const LeastHeights& heights,
           std::vector<float>& result) {
    scan_convert(ground, triangles, tile_, centres_, ground_);
    for (std::int64_t r = 0; r < tile_.rows; r += kPacketSide)
      for (std::int64_t c = 0; c < tile_.columns; c += kPacketSide) look(r, c, heights, result);
  }

 private:
  void look(std::int64_t row, std::int64_t column, const LeastHeights& heights, std::vector<float>& result) {
    SightLines lines;
    lines.start_at(radar_.units);
    LeastHeights::Heights lower{};
    for (unsigned i = 0; i < SightLines::kSize; ++i) {
      const std::int64_t r = row + i / kPacketSide, c = column + i % kPacketSide;
      if (r >= tile_.rows || c >= tile_.columns) continue;
      lower[i] = ground_[static_cast<std::size_t>(r * Tile::kSide + c)];
      if (std::isnan(lower[i])) continue;
      lines.to_x[i] = centres_.x[static_cast<std::size_t>(c)], lines.to_y[i] = centres_.y[static_cast<std::size_t>(r)];
      lines.to_z[i] = lower[i] + kRadarCeiling / units_.resolution;
      if (lines.to_x[i] == radar_.units.x && lines.to_y[i] == radar_.units.y) {
        result[cell(r, c)] = 0;
      } else {
        lines.active |= 1U << i;
      }
    }
    if (lines.active == 0) return;
    const LeastHeights::Heights least = heights.find(lines, lower, memory_);
    for (unsigned i = 0; i < SightLines::kSize; ++i)
      if (!std::isnan(least[i]))
        result[cell(row + i / kPacketSide, column + i % kPacketSide)] =
            static_cast<float>((least[i] - lower[i]) * units_.resolution);
  }
  std::size_t cell(std::int64_t r, std::int64_t c) const { return grid_.index({tile_.column + c, tile_.row + r}); }

  const Eye& radar_;
  Grid units_;
  const RasterGrid& grid_;
  Tile tile_;
  TileCentres centres_;
  TileValues<double> ground_{};
  LeastHeights::Memory memory_;
};

}  // namespace

std::vector<float> radar_heights(const Eye& radar, const Tin& ground, const TriangleBins& bins, const RasterGrid& tiles,
                                 const RasterGrid& grid, const LeastHeights& heights, Progress& progress) {
  std::vector<float> result(grid.cell_count(), std::numeric_limits<float>::quiet_NaN());
  progress.report("radar", 0);
  parallel_for(tiles.cell_count(), [&](std::size_t i) {
    progress.throw_if_cancelled();
    const auto tile = std::make_unique<RadarTile>(radar, ground, grid, tile_at(grid, tiles, i));
    tile->run(ground, bins.triangles(i), heights, result);
  });
  return result;
}

double radar_sees(const Eye& radar, const Tin& ground, const Turbine& turbine, double ground_m,
                  const LeastHeights& heights) {
  const double per_metre = 1 / ground.grid.resolution;
  SightLines lines;
  lines.from_x[0] = radar.units.x, lines.from_y[0] = radar.units.y, lines.from_z[0] = radar.units.z;
  lines.to_x[0] = easting_in_units(ground.grid, turbine.position.x);
  lines.to_y[0] = northing_in_units(ground.grid, turbine.position.y);
  lines.to_z[0] = (ground_m + turbine.tip_height) * per_metre;
  if (lines.to_x[0] == lines.from_x[0] && lines.to_y[0] == lines.from_y[0]) return turbine.tip_height;
  lines.active = 1;
  LeastHeights::Heights lower{};
  lower[0] = ground_m * per_metre;
  LeastHeights::Memory memory;
  const double least = heights.find(lines, lower, memory)[0];
  return std::isnan(least) ? 0 : (lines.to_z[0] - least) * ground.grid.resolution;
}

}  // namespace itin::viewshed
