#include "turbines/output/count_classes.hpp"

#include <algorithm>

#include <fmt/format.h>

#include <viewshed/zone_files.hpp>

#include "line/infinity.hpp"

namespace itin::viewshed {

std::size_t known_hubs(const Zone& zone) {
  const std::vector<Turbine>& turbines = zone.request.turbines;
  return static_cast<std::size_t>(
      std::count_if(turbines.begin(), turbines.end(), [](const Turbine& t) { return t.hub_height.has_value(); }));
}

std::string of_known_hubs(const Zone& zone) {
  const std::size_t known = known_hubs(zone), all = zone.request.turbines.size();
  return known == all ? "" : fmt::format(" of {} of {} turbines", known, all);
}

std::vector<ValueBand> count_bands(const Zone& zone, TurbinePart part) {
  return count_bands(part == TurbinePart::kHub ? known_hubs(zone) : zone.request.turbines.size(),
                     zone.request.count_bands);
}

CountClasses::CountClasses(const Zone& zone, const Visibility& visibility, TurbinePart part)
    : counts_(part == TurbinePart::kHub ? visibility.hub_count : visibility.tip_count),
      undecided_(part == TurbinePart::kHub ? visibility.hub_undecided : visibility.tip_undecided),
      classes_(count_bands(zone, part)) {
  if (!zone.leaves_open()) return;
  undecided_class_ = classes_.size();
  classes_.push_back({kInfinity, kUndecidedSeen, kUndecidedGrey});
}

CountClasses::CountClasses(const Zone& zone, const SeasonCounts& season, TurbinePart part)
    : counts_(part == TurbinePart::kHub ? season.hub_count : season.tip_count),
      undecided_(counts_),
      classes_(count_bands(zone, part)) {}

std::optional<std::size_t> CountClasses::of(std::size_t cell) const {
  if (counts_[cell] == kCountOutside) return std::nullopt;
  const bool undecided = undecided_class_ && counts_[cell] == 0 && undecided_[cell] > 0;
  return undecided ? undecided_class_ : band_of(classes_, counts_[cell]);
}

}  // namespace itin::viewshed
