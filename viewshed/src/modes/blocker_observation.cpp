#include "modes/blocker_observation.hpp"

#include <limits>

namespace itin::viewshed {

BlockerObservation::BlockerObservation(const FirstBlocker& blockers) : blockers_(blockers) {
  squared_.fill(std::numeric_limits<double>::infinity());
  observer_.fill(0);
  triangle_.fill(kNoBlocker);
}

void BlockerObservation::judge(const Look& look, const Sight& sight) {
  if (sight.seen) return see(look);
  const double squared = look.squared_distance();
  const bool nearer =
      squared < squared_[look.cell] || (squared == squared_[look.cell] && look.observer < observer_[look.cell]);
  if (!nearer) return;
  const auto blocker = blockers_.find(sight.from, sight.to);
  squared_[look.cell] = squared;
  observer_[look.cell] = look.observer;
  triangle_[look.cell] = blocker ? blocker->triangle : kMissingGround;
}

void BlockerObservation::store_row(std::size_t cell, std::size_t columns, std::size_t place, Result& result) const {
  for (std::size_t i = 0; i < columns; ++i)
    result.blocker[place + i] = value(cell + i) == Verdict::kHidden ? triangle_[cell + i] : kNoBlocker;
}

}  // namespace itin::viewshed
