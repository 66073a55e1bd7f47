#include "judge/envelope_scene.hpp"

#include <bit>

#include <viewshed/request.hpp>

#include "bounds/boundary.hpp"

namespace itin::viewshed {

EnvelopeScene::EnvelopeScene(Envelope e, const Request& request, const RasterGrid& tiles, NoData r)
    : envelope(std::move(e)),
      lower(envelope.lower, request.earth),
      bins(envelope.lower, tiles),
      rule(r),
      exact(envelope.exact),
      drop(request.earth.drop_coefficient() * envelope.lower.grid.resolution) {
  if (!exact) upper_.emplace(envelope.upper, request.earth, kGrazing / 2);
  if (envelope.bare_ground) ground_bins.emplace(*envelope.bare_ground, tiles);
  if (rule != NoData::kClear) rim_ = rim_of(envelope.upper, envelope.outline);
}

EnvelopeScene::View EnvelopeScene::view_from(const Eye& eye) const {
  View view{eye};
  if (rule != NoData::kClear) view.shadow = std::make_shared<const VoidShadow>(rim_, eye.units, rule);
  return view;
}

EnvelopeScene::Decided EnvelopeScene::decide(EnvelopePacket& packet) const {
  const unsigned all = packet.low.active;
  // Most of what an observer on the ground looks at is hidden.
  packet.high.active = all & ~packet.perhaps_outside;
  const unsigned hidden = packet.high.active == 0 ? 0 : lower.hidden(packet.high);
  packet.low.active = packet.high.active & ~packet.behind_void & ~hidden;
  const unsigned cast = exact ? 0 : packet.low.active;
  const unsigned visible = packet.low.active & ~(cast == 0 ? 0 : upper_->hidden(packet.low));
  const int lines = std::popcount(cast) + std::popcount(packet.high.active);
  packet.low.active = all & ~visible & ~hidden;
  return {visible, hidden, static_cast<unsigned>(lines)};
}

}  // namespace itin::viewshed
