#include "least_height_observation.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "request.hpp"

namespace itin::viewshed {

namespace {

/// A height this little above one that is asked for may be due to what grazing allows.
constexpr double kHair = 0.01;

}  // namespace

LeastHeightObservation::LeastHeightObservation(const LeastHeights& heights, const std::vector<Eye>& eyes,
                                               double resolution)
    : heights_(heights), eyes_(eyes), resolution_(resolution) {
  least_.fill(std::numeric_limits<double>::infinity());
}

bool LeastHeightObservation::in_view(const Eye& eye, const Look& look) const {
  return eye.view.contains(look.dx, look.dy, look.dz, kSky) != false;
}

bool LeastHeightObservation::open(const Look& look) const {
  return least_[look.cell] > 0 || value(look.cell) != kVisible;
}

void LeastHeightObservation::keep(const Look& look) {
  least_[look.cell] = 0;
}

LeastHeightObservation::Bounds LeastHeightObservation::bounds(const Look& look, double ground) const {
  const Eye& eye = eyes_[look.observer];
  Bounds b{ground, kSky / resolution_};
  if (const auto range = eye.view.heights_at(look.squared_distance())) {
    b.lower = std::max(b.lower, (eye.elevation + range->first) / resolution_);
    b.upper = std::min(b.upper, (eye.elevation + range->second) / resolution_);
  }
  // What is known to be seen by another observer, unless the target that counts as visible is higher.
  const double wanted = eye.target(ground * resolution_) / resolution_;
  return {b.lower, std::min(b.upper, std::max(ground + least_[look.cell] / resolution_, wanted))};
}

void LeastHeightObservation::judge(const LookPacket& packet, const Scene& scene, Occluder&) {
  SightLines lines = packet.lines;
  LeastHeights::Heights lower{};
  for (unsigned rest = packet.lines.active; rest != 0; rest &= rest - 1) {
    const auto i = static_cast<unsigned>(std::countr_zero(rest));
    const Bounds b = bounds(packet.looks[i], packet.lines.to_z[i]);
    lower[i] = b.lower;
    lines.to_z[i] = b.upper;
    if (b.lower > b.upper) lines.active &= ~(1U << i);
  }
  const LeastHeights::Heights found = heights_.find(lines, lower, memory_);
  for (unsigned rest = lines.active; rest != 0; rest &= rest - 1) {
    const auto i = static_cast<unsigned>(std::countr_zero(rest));
    if (!std::isnan(found[i])) settle(packet.looks[i], packet.lines, i, found[i], scene);
  }
}

void LeastHeightObservation::settle(const Look& look, const SightLines& lines, unsigned i, double least,
                                    const Scene& scene) {
  const double ground = lines.to_z[i], wanted = eyes_[look.observer].target(ground * resolution_) / resolution_;
  const Bounds allowed = bounds(look, ground);
  const auto seen_at = [&](double end) {
    if (end < allowed.lower || end > allowed.upper) return false;
    if (least <= end) return true;
    if ((least - end) * resolution_ > kHair) return false;
    SightLines line = lines;
    line.to_z[i] = end;
    return !scene.hidden_between(line, i, 0, 1);
  };
  const double height = seen_at(ground) ? 0 : (least - ground) * resolution_;
  least_[look.cell] = std::min(least_[look.cell], height);
  if (seen_at(wanted)) mark_visible(look.cell);
}

void LeastHeightObservation::store_row(std::size_t cell, std::size_t columns, std::size_t place, Result& result) const {
  for (std::size_t i = 0; i < columns; ++i)
    result.least_height_m[place + i] =
        value(cell + i) == kOutside ? std::numeric_limits<float>::quiet_NaN() : static_cast<float>(least_[cell + i]);
}

}  // namespace itin::viewshed
