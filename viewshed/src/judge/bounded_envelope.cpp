#include "judge/bounded_envelope.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace itin::viewshed {

namespace {

/// This number of bins per triangle follows the slopes of a level, and no more bins than that take but a moment.
constexpr double kBinsPerTriangle = 64, kMostBins = 1 << 21;

}  // namespace

BoundedEnvelope::BoundedEnvelope(Envelope envelope, const RasterGrid& tiles, const TargetRises& rises)
    : envelope_(std::move(envelope)), triangles_(envelope_.lower, tiles), rises_(rises) {}

void BoundedEnvelope::bound(const Box& box) {
  if (bounds_ && box_ == box) return;
  const double triangles = static_cast<double>(envelope_.lower.triangles.size()) + 1;
  const double side = std::sqrt(box.width() * box.height() / std::min(kMostBins, kBinsPerTriangle * triangles));
  bounds_ = std::make_unique<EnvelopeBounds>(envelope_.lower, envelope_.upper, envelope_.outline, box,
                                             std::max(side, envelope_.lower.grid.resolution));
  box_ = box;
}

}  // namespace itin::viewshed
