#include "certified_pass.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include <viewshed/certified.hpp>

#include "request.hpp"

namespace itin::viewshed {

namespace {

std::optional<Curtains> curtains(const Envelope& envelope, const Request& request, Voids voids) {
  if (voids == Voids::kPass || envelope.outline.empty()) return std::nullopt;
  return Curtains{envelope.outline, ceiling_of(envelope.upper, request)};
}

}  // namespace

EnvelopeScene::EnvelopeScene(Envelope e, const Request& request, const RasterGrid& tiles, Voids voids)
    : envelope(std::move(e)),
      lower(envelope.lower, request.earth, voids == Voids::kBlock ? NoData::kBlock : NoData::kClear,
            ceiling_of(envelope.upper, request), envelope.outline),
      upper(envelope.upper, envelope.pieces, request.earth, curtains(envelope, request, voids)),
      bins(envelope.lower, tiles),
      exact(envelope.exact) {
  if (envelope.bare_ground) ground_bins.emplace(*envelope.bare_ground, tiles);
}

EnvelopeScene::Look EnvelopeScene::look_from(const Eye& eye) const {
  const Tin& tin = envelope.upper;
  double highest = -std::numeric_limits<double>::infinity();
  const auto apart = [](double v, std::int32_t a, std::int32_t b, std::int32_t c) {
    return (v < a && v < b && v < c) || (v > a && v > b && v > c);
  };
  for (std::uint32_t t = 0; t < tin.triangles.size(); ++t) {
    const auto& [i, j, k] = tin.triangles[t];
    const GridPoint &a = tin.vertices[i], &b = tin.vertices[j], &c = tin.vertices[k];
    if (apart(eye.units.x, a.x, b.x, c.x) || apart(eye.units.y, a.y, b.y, c.y)) continue;
    if (const auto height = surface_height(tin, {&t, 1}, eye.position)) highest = std::max(highest, *height);
  }
  return {eye, highest};
}

CertifiedPass::CertifiedPass(const EnvelopeScene& scene, const RasterGrid& grid, const RasterGrid& tiles)
    : scene_(scene), grid_(grid), tiles_(tiles) {}

std::unique_ptr<CertifiedPass::TileWork> CertifiedPass::begin(std::size_t tile) const {
  auto work = std::make_unique<TileWork>(scene_.envelope.lower.grid, grid_, tile_at(grid_, tiles_, tile));
  const auto triangles = scene_.bins.triangles(tile);
  if (scene_.ground_bins) {
    scan_convert(*scene_.envelope.bare_ground, scene_.ground_bins->triangles(tile), work->tile, work->centres,
                 work->low);
  } else {
    scan_convert(scene_.envelope.lower, triangles, work->tile, work->centres, work->low);
  }
  scan_convert_highest(scene_.envelope.upper, triangles, work->tile, work->centres, work->high);
  return work;
}

/// Sixteen cells on their way.
struct CertifiedPass::Packet {
  std::size_t row, column;
  SightLines low, high;    ///< to the lowest and to the highest target
  unsigned ambiguous = 0;  ///< perhaps outside the field of view
  unsigned starts_under = 0, ends_under = 0;

  std::size_t cell(unsigned i) const { return (row + i / kPacketSide) * Tile::kSide + column + i % kPacketSide; }
};

void CertifiedPass::fill(const EnvelopeScene::Look& look, TileValues<std::uint8_t>& values, const TileWork& work,
                         Packet& packet) const {
  const Eye& eye = look.eye;
  // The arithmetic of plain viewsheds, to the last bit.
  const double resolution = scene_.envelope.lower.grid.resolution, metre = 1 / resolution;
  const double grazing = kGrazing / resolution;
  for (unsigned i = 0; i < SightLines::kSize; ++i) {
    const std::size_t r = packet.row + i / kPacketSide, c = packet.column + i % kPacketSide, cell = packet.cell(i);
    std::uint8_t& value = values[cell];
    if (value != kUndecided) continue;
    if (std::isnan(work.low[cell])) {
      value = kOutside;
      continue;
    }
    const double ground_low = work.low[cell], ground_high = scene_.exact ? ground_low : work.high[cell];
    const double low_m = eye.target(ground_low * resolution), high_m = eye.target(ground_high * resolution);
    const double low = low_m * metre, high = high_m * metre;
    const Point2 centre =
        grid_.centre(work.tile.column + static_cast<std::int64_t>(c), work.tile.row + static_cast<std::int64_t>(r));
    const double dx = centre.x - eye.position.x, dy = centre.y - eye.position.y;
    const std::optional<bool> in_view = eye.view.contains(dx, dy, low_m - eye.elevation, high_m - eye.elevation);
    if (in_view == false) {
      value = kOutside;
      continue;
    }
    if (high < ground_low - grazing && in_view) {  // an elevation below the ground
      value = kCertainlyHidden;
      continue;
    }
    const double x = work.centres.x[c], y = work.centres.y[r];
    if (x == eye.units.x && y == eye.units.y) {
      if (in_view) value = kCertainlyVisible;
      continue;
    }
    const unsigned bit = 1U << i;
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

void CertifiedPass::judge(const EnvelopeScene::Look& look, TileValues<std::uint8_t>& values, TileWork& work,
                          const OnDoubtful& doubtful) const {
  const auto rows = static_cast<std::size_t>(work.tile.rows), columns = static_cast<std::size_t>(work.tile.columns);
  for (std::size_t row = 0; row < rows; row += kPacketSide) {
    for (std::size_t column = 0; column < columns; column += kPacketSide) {
      Packet packet{.row = row, .column = column, .low = {}, .high = {}};
      for (SightLines* const lines : {&packet.low, &packet.high}) {
        lines->from_x.fill(look.eye.units.x);
        lines->from_y.fill(look.eye.units.y);
        lines->from_z.fill(look.eye.units.z);
      }
      fill(look, values, work, packet);
      const unsigned all = packet.low.active, under = packet.starts_under | packet.ends_under | packet.ambiguous;
      if (all == 0) continue;
      packet.low.active = all & ~under;
      const unsigned visible = packet.low.active & ~scene_.upper.touched(packet.low);
      packet.high.active = all & ~visible & ~packet.ambiguous;
      const unsigned hidden = packet.high.active == 0 ? 0 : scene_.lower.hidden(packet.high, work.occluder);
      work.rays += static_cast<unsigned>(std::popcount(all & ~under) + std::popcount(packet.high.active));
      for (unsigned rest = visible | hidden; rest != 0; rest &= rest - 1) {
        const auto i = static_cast<unsigned>(std::countr_zero(rest));
        values[packet.cell(i)] = (visible >> i & 1) != 0 ? kCertainlyVisible : kCertainlyHidden;
      }
      packet.low.active = all & ~visible & ~hidden;
      if (packet.low.active != 0 && doubtful)
        doubtful({packet.low, packet.starts_under, packet.ends_under, row, column});
    }
  }
}

}  // namespace itin::viewshed
