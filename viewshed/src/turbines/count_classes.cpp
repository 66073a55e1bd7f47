#include "turbines/count_classes.hpp"

#include "line/infinity.hpp"

namespace itin::viewshed {

CountClasses::CountClasses(const Zone& zone, const std::vector<std::uint16_t>& counts,
                           const std::vector<std::uint16_t>& undecided)
    : counts_(counts),
      undecided_(undecided),
      classes_(count_bands(zone.request.turbines.size(), zone.request.count_bands)) {
  if (!zone.leaves_open()) return;
  undecided_class_ = classes_.size();
  classes_.push_back({kInfinity, kUndecidedSeen, kUndecidedGrey});
}

std::optional<std::size_t> CountClasses::of(std::size_t cell) const {
  if (counts_[cell] == kCountOutside) return std::nullopt;
  const bool undecided = undecided_class_ && counts_[cell] == 0 && undecided_[cell] > 0;
  return undecided ? undecided_class_ : band_of(classes_, counts_[cell]);
}

}  // namespace itin::viewshed
