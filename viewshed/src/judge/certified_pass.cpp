#include "judge/certified_pass.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>

#include <viewshed/viewshed.hpp>

#include "bounds/surface_heights.hpp"
#include "request/request.hpp"

namespace itin::viewshed {

EnvelopeScene::EnvelopeScene(Envelope e, const Request& request, const RasterGrid& tiles, Voids v)
    : envelope(std::move(e)),
      lower(envelope.lower, request.earth),
      upper(envelope.upper, envelope.pieces, request.earth),
      bins(envelope.lower, tiles),
      voids(v),
      exact(envelope.exact),
      drop(request.earth.drop_coefficient() * envelope.lower.grid.resolution),
      tiles_(tiles) {
  if (envelope.bare_ground) ground_bins.emplace(*envelope.bare_ground, tiles);
}

EnvelopeScene::Look EnvelopeScene::look_from(const Eye& eye) const {
  const auto tile = tiles_.cell_at(eye.position);
  std::vector<std::uint32_t> all;
  if (!tile) {
    all.resize(envelope.upper.triangles.size());
    std::iota(all.begin(), all.end(), 0U);
  }
  Look look{eye, upper_height(eye, tile ? bins.triangles(tiles_.index(*tile)) : all)};
  if (voids != Voids::kPass) look.shadow.emplace(rim_of(envelope.upper, envelope.outline), eye.units, voids);
  return look;
}

double EnvelopeScene::upper_height(const Eye& eye, std::span<const std::uint32_t> triangles) const {
  const Tin& tin = envelope.upper;
  double highest = -std::numeric_limits<double>::infinity();
  const auto apart = [](double v, std::int32_t a, std::int32_t b, std::int32_t c) {
    return (v < a && v < b && v < c) || (v > a && v > b && v > c);
  };
  for (const std::uint32_t t : triangles) {
    const auto& [i, j, k] = tin.triangles[t];
    const GridPoint &a = tin.vertices[i], &b = tin.vertices[j], &c = tin.vertices[k];
    if (apart(eye.units.x, a.x, b.x, c.x) || apart(eye.units.y, a.y, b.y, c.y)) continue;
    if (const auto height = surface_height(tin, {&t, 1}, eye.position)) highest = std::max(highest, *height);
  }
  return highest;
}

CertifiedPass::CertifiedPass(const EnvelopeScene& scene, const RasterGrid& grid, const RasterGrid& tiles)
    : scene_(scene), grid_(grid), tiles_(tiles) {}

namespace {

CertifiedPass::BlockValues highest_by_block(const TileValues<double>& heights, const Tile& tile) {
  CertifiedPass::BlockValues highest;
  highest.fill(-std::numeric_limits<double>::infinity());
  for_each_cell(tile, [&](std::size_t cell, RasterGrid::Cell) {
    const std::size_t r = cell / Tile::kSide, c = cell % Tile::kSide;
    const std::size_t block = r / CertifiedPass::kBlockSide * CertifiedPass::kBlocks + c / CertifiedPass::kBlockSide;
    // Not a number where there is no surface: then nothing is higher.
    if (heights[cell] > highest[block]) highest[block] = heights[cell];
  });
  return highest;
}

}  // namespace

std::unique_ptr<CertifiedPass::TileWork> CertifiedPass::begin(std::size_t tile) const {
  auto work = std::make_unique<TileWork>(scene_.envelope.lower.grid, grid_, tile_at(grid_, tiles_, tile));
  const auto triangles = scene_.bins.triangles(tile);
  scan_convert(scene_.envelope.lower, triangles, work->tile, work->centres, work->low);
  scan_convert_highest(scene_.envelope.upper, triangles, work->tile, work->centres, work->high);
  work->highest = highest_by_block(work->high, work->tile);
  return work;
}

/// Sixteen cells on their way.
struct CertifiedPass::Packet {
  std::size_t row, column;
  SightLines low, high;    ///< to the lowest and to the highest target
  unsigned ambiguous = 0;  ///< perhaps outside the field of view
  unsigned starts_under = 0, ends_under = 0;
  unsigned behind_void = 0;

  std::size_t cell(unsigned i) const { return (row + i / kPacketSide) * Tile::kSide + column + i % kPacketSide; }
};

void CertifiedPass::fill(const EnvelopeScene::Look& look, TileValues<Verdict>& values, const TileWork& work,
                         Packet& packet) const {
  const Eye& eye = look.eye;
  // The arithmetic of plain viewsheds, to the last bit.
  const double resolution = scene_.envelope.lower.grid.resolution, metre = 1 / resolution;
  const double grazing = kGrazing / resolution;
  for (unsigned i = 0; i < SightLines::kSize; ++i) {
    const std::size_t r = packet.row + i / kPacketSide, c = packet.column + i % kPacketSide, cell = packet.cell(i);
    Verdict& value = values[cell];
    if (value != Verdict::kUndecided) continue;
    if (std::isnan(work.low[cell])) {
      value = Verdict::kOutside;
      continue;
    }
    const double ground_low = work.low[cell], ground_high = work.high[cell];
    const double low_m = eye.target(ground_low * resolution), high_m = eye.target(ground_high * resolution);
    const double low = low_m * metre, high = high_m * metre;
    const Point2 centre =
        grid_.centre(work.tile.column + static_cast<std::int64_t>(c), work.tile.row + static_cast<std::int64_t>(r));
    const double x = work.centres.x[c], y = work.centres.y[r];
    const auto [dx, dy] = eye.offset_to(centre, {x, y});
    const std::optional<bool> in_view = eye.view.contains(dx, dy, low_m - eye.elevation, high_m - eye.elevation);
    if (in_view == false) {
      value = Verdict::kOutside;
      continue;
    }
    if (high < ground_low - grazing && in_view) {  // an elevation below the ground
      value = Verdict::kHidden;
      continue;
    }
    if (in_view && eye.stands_at({x, y})) {
      value = Verdict::kVisible;
      continue;
    }
    const unsigned bit = 1U << i;
    if (look.shadow && look.shadow->holds(x, y)) {
      if (scene_.voids == Voids::kBlock && in_view) {
        value = Verdict::kHidden;
        continue;
      }
      packet.behind_void |= bit;
    }
    packet.low.to_x[i] = packet.high.to_x[i] = x;
    packet.low.to_y[i] = packet.high.to_y[i] = y;
    packet.low.to_z[i] = low;
    packet.high.to_z[i] = high;
    packet.low.active |= bit;
    if (!in_view) packet.ambiguous |= bit;
    const double dz = low - eye.units.z;
    const double clear = 2 * scene_.upper.error_bound(std::sqrt((dx * dx + dy * dy) * metre * metre + dz * dz));
    if (eye.units.z < look.upper + clear) packet.starts_under |= bit;
    if (low < work.high[cell] + clear) packet.ends_under |= bit;
  }
}

/// Aims four lines, the first of them number `first`, at the corners of a flat piece above all targets of the block;
/// not where that cannot hide it as a whole.
bool CertifiedPass::aim(const EnvelopeScene::Look& look, const TileWork& work, const CellBlock& block, unsigned first,
                        SightLines& lines) const {
  const Eye& eye = look.eye;
  double highest = -std::numeric_limits<double>::infinity();
  for (std::size_t r = block.row0 / kBlockSide; r <= block.row1 / kBlockSide; ++r)
    for (std::size_t c = block.column0 / kBlockSide; c <= block.column1 / kBlockSide; ++c)
      highest = std::max(highest, work.highest[r * kBlocks + c]);
  if (!std::isfinite(highest)) return false;
  const double resolution = scene_.envelope.lower.grid.resolution;
  const double west = work.centres.x[block.column0], east = work.centres.x[block.column1];
  const double north = work.centres.y[block.row0], south = work.centres.y[block.row1];
  const auto squared = [&](double x, double y) {
    return (x - eye.units.x) * (x - eye.units.x) + (y - eye.units.y) * (y - eye.units.y);
  };
  const Point2 near{std::clamp(eye.units.x, west, east), std::clamp(eye.units.y, south, north)};
  const double nearest = squared(near.x, near.y);
  double farthest = 0;
  for (unsigned i = 0; i < 4; ++i) {
    const double x = i % 2 == 0 ? west : east, y = i < 2 ? north : south, distance = squared(x, y);
    farthest = std::max(farthest, distance);
    // Level as the eye sees it: as far below it as the highest target would be at the nearest place. Rounding is far
    // less than what a line must be hidden by.
    lines.to_x[first + i] = x;
    lines.to_y[first + i] = y;
    lines.to_z[first + i] =
        (eye.target(highest * resolution) + 4 * kGrazing) / resolution + scene_.drop * (distance - nearest);
  }
  const double squared_metre = resolution * resolution;
  if (eye.stands_at(near) || !eye.view.holds(nearest * squared_metre, farthest * squared_metre)) return false;
  lines.active |= 0xfU << first;
  return true;
}

/// Hides what it can of the four blocks of this side, or of their quarters: most of what an observer on the ground
/// looks at is hidden, and a triangle nearer by hides many cells.
void CertifiedPass::hide_quarters(const EnvelopeScene::Look& look, TileValues<Verdict>& values, TileWork& work,
                                  std::size_t row, std::size_t column, std::size_t side) const {
  const auto rows = static_cast<std::size_t>(work.tile.rows), columns = static_cast<std::size_t>(work.tile.columns);
  SightLines lines;
  lines.start_at(look.eye.units);
  std::array<CellBlock, 4> blocks{};
  for (unsigned q = 0; q < 4; ++q) {
    const std::size_t r = row + q / 2 * side, c = column + q % 2 * side;
    if (r >= rows || c >= columns) continue;
    blocks[q] = {r, std::min(r + side, rows), c, std::min(c + side, columns)};
    aim(look, work, {r, blocks[q].row1 - 1, c, blocks[q].column1 - 1}, 4 * q, lines);
  }
  const unsigned hidden = lines.active == 0 ? 0 : scene_.lower.hidden_together(lines, work.occluder);
  work.rays += static_cast<unsigned>(std::popcount(lines.active));
  for (unsigned q = 0; q < 4; ++q) {
    const CellBlock& block = blocks[q];
    if (block.row1 == 0) continue;
    if ((hidden >> q & 1) == 0) {
      if (side > kBlockSide) hide_quarters(look, values, work, block.row0, block.column0, side / 2);
      continue;
    }
    for (std::size_t r = block.row0; r < block.row1; ++r) {
      for (std::size_t c = block.column0; c < block.column1; ++c) {
        const std::size_t cell = r * Tile::kSide + c;
        if (values[cell] == Verdict::kUndecided)
          values[cell] = std::isnan(work.low[cell]) ? Verdict::kOutside : Verdict::kHidden;
      }
    }
  }
}

void CertifiedPass::judge(const EnvelopeScene::Look& look, TileValues<Verdict>& values, TileWork& work,
                          const OnDoubtful& doubtful) const {
  const auto rows = static_cast<std::size_t>(work.tile.rows), columns = static_cast<std::size_t>(work.tile.columns);
  if (std::find(values.begin(), values.end(), Verdict::kUndecided) == values.end()) return;
  hide_quarters(look, values, work, 0, 0, Tile::kSide / 2);
  for (std::size_t row = 0; row < rows; row += kPacketSide) {
    for (std::size_t column = 0; column < columns; column += kPacketSide) {
      Packet packet{.row = row, .column = column, .low = {}, .high = {}};
      for (SightLines* const lines : {&packet.low, &packet.high}) lines->start_at(look.eye.units);
      fill(look, values, work, packet);
      const unsigned all = packet.low.active,
                     under = packet.starts_under | packet.ends_under | packet.ambiguous | packet.behind_void;
      if (all == 0) continue;
      // Most of what an observer on the ground looks at is hidden.
      packet.high.active = all & ~packet.ambiguous;
      const unsigned hidden = packet.high.active == 0 ? 0 : scene_.lower.hidden(packet.high, work.occluder);
      packet.low.active = all & ~under & ~hidden;
      const unsigned visible = packet.low.active & ~scene_.upper.touched(packet.low);
      work.rays += static_cast<unsigned>(std::popcount(packet.low.active) + std::popcount(packet.high.active));
      for (unsigned rest = visible | hidden; rest != 0; rest &= rest - 1) {
        const auto i = static_cast<unsigned>(std::countr_zero(rest));
        values[packet.cell(i)] = (visible >> i & 1) != 0 ? Verdict::kVisible : Verdict::kHidden;
      }
      packet.low.active = all & ~visible & ~hidden;
      if (packet.low.active != 0 && doubtful)
        doubtful({packet.low, packet.starts_under, packet.ends_under, row, column});
    }
  }
}

}  // namespace itin::viewshed
