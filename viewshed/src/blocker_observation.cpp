#include "blocker_observation.hpp"

#include <bit>
#include <limits>

namespace itin::viewshed {

BlockerObservation::BlockerObservation(const FirstBlocker& blockers) : blockers_(blockers) {
  squared_.fill(std::numeric_limits<double>::infinity());
  observer_.fill(0);
  triangle_.fill(kNoBlocker);
}

void BlockerObservation::judge(const LookPacket& packet, const Scene& scene, Occluder& occluder) {
  const unsigned hidden = scene.hidden(packet.lines, occluder);
  for (unsigned rest = packet.lines.active; rest != 0; rest &= rest - 1) {
    const auto i = static_cast<unsigned>(std::countr_zero(rest));
    const Look& look = packet.looks[i];
    if ((hidden >> i & 1) == 0) {
      see(look);
      continue;
    }
    const double squared = look.squared_distance();
    const bool nearer =
        squared < squared_[look.cell] || (squared == squared_[look.cell] && look.observer < observer_[look.cell]);
    if (!nearer) continue;
    const auto blocker = blockers_.find(packet.lines, i);
    squared_[look.cell] = squared;
    observer_[look.cell] = look.observer;
    triangle_[look.cell] = blocker ? blocker->triangle : kMissingGround;
  }
}

void BlockerObservation::store_row(std::size_t cell, std::size_t columns, std::size_t place, Result& result) const {
  for (std::size_t i = 0; i < columns; ++i)
    result.blocker[place + i] = value(cell + i) == kHidden ? triangle_[cell + i] : kNoBlocker;
}

}  // namespace itin::viewshed
