#include "judge/bounded_envelope.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace itin::viewshed {

BoundedEnvelope::BoundedEnvelope(Envelope envelope, const RasterGrid& tiles, const TargetRises& rises)
    : envelope_(std::move(envelope)), triangles_(envelope_.lower, tiles), rises_(rises) {}

void BoundedEnvelope::bound(const Box& box) {
  if (bounds_ && box_ == box) return;
  bounds_ = std::make_unique<EnvelopeBounds>(envelope_.lower, envelope_.upper, envelope_.outline, box,
                                             side_of_bins(envelope_.lower, box));
  box_ = box;
}

void BoundedEnvelope::bound_for(const Eye& eye) {
  const Box ground = envelope_.lower.bounds();
  const double reach = eye.view.farthest();
  bound(std::isfinite(reach) ? intersection(square_about(eye.position, reach), ground) : ground);
}

}  // namespace itin::viewshed
