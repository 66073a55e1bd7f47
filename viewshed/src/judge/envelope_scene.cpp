#include "judge/envelope_scene.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

#include <viewshed/request.hpp>

#include "bounds/boundary.hpp"
#include "bounds/surface_heights.hpp"
#include "line/infinity.hpp"

namespace itin::viewshed {

EnvelopeScene::EnvelopeScene(Envelope e, const Request& request, const RasterGrid& tiles, NoData r)
    : envelope(std::move(e)),
      lower(envelope.lower, request.earth),
      upper(envelope.upper, envelope.pieces, envelope.drift, request.earth),
      bins(envelope.lower, tiles),
      rule(r),
      exact(envelope.exact),
      drop(request.earth.drop_coefficient() * envelope.lower.grid.resolution),
      tiles_(tiles) {
  if (envelope.bare_ground) ground_bins.emplace(*envelope.bare_ground, tiles);
  if (rule != NoData::kClear) rim_ = rim_of(envelope.upper, envelope.outline);
}

EnvelopeScene::View EnvelopeScene::view_from(const Eye& eye) const {
  const auto tile = tiles_.cell_at(eye.position);
  std::vector<std::uint32_t> all;
  if (!tile) {
    all.resize(envelope.upper.triangles.size());
    std::iota(all.begin(), all.end(), 0U);
  }
  View view{eye, upper_height(eye, tile ? bins.triangles(tiles_.index(*tile)) : all)};
  if (rule != NoData::kClear) view.shadow = std::make_shared<const VoidShadow>(rim_, eye.units, rule);
  return view;
}

double EnvelopeScene::upper_height(const Eye& eye, std::span<const std::uint32_t> triangles) const {
  const Tin& tin = envelope.upper;
  double highest = -kInfinity;
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

void EnvelopeScene::aim(const View& view, const EnvelopeTarget& target, unsigned i, EnvelopePacket& packet) const {
  const unsigned bit = 1U << i;
  packet.low.to_x[i] = packet.high.to_x[i] = target.place.x;
  packet.low.to_y[i] = packet.high.to_y[i] = target.place.y;
  packet.low.to_z[i] = target.low;
  packet.high.to_z[i] = target.high;
  packet.low.active |= bit;
  const double metre = 1 / envelope.lower.grid.resolution, dz = target.low - view.eye.units.z;
  const double clear = 2 * upper.error_bound(std::sqrt(target.squared_m * metre * metre + dz * dz));
  if (view.eye.units.z < view.upper + clear) packet.starts_under |= bit;
  if (target.low < target.surface + clear) packet.ends_under |= bit;
}

EnvelopeScene::Decided EnvelopeScene::decide(EnvelopePacket& packet, Occluder& occluder) const {
  const unsigned all = packet.low.active;
  // Most of what an observer on the ground looks at is hidden.
  packet.high.active = all & ~packet.perhaps_outside;
  const unsigned hidden = packet.high.active == 0 ? 0 : lower.hidden(packet.high, occluder);
  packet.low.active = packet.high.active & ~(packet.starts_under | packet.ends_under | packet.behind_void) & ~hidden;
  const unsigned visible = packet.low.active == 0 ? 0 : packet.low.active & ~upper.touched(packet.low);
  const int lines = std::popcount(packet.low.active) + std::popcount(packet.high.active);
  packet.low.active = all & ~visible & ~hidden;
  return {visible, hidden, static_cast<unsigned>(lines)};
}

}  // namespace itin::viewshed
