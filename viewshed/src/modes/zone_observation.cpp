#include "modes/zone_observation.hpp"

#include <algorithm>

#include "judge/zone_cut.hpp"

namespace itin::viewshed {

/// A line that missing ground leaves undecided stays so, whatever known ground does to its zone.
void ZoneObservation::qualify(const TileView& tile, TileValues<Verdict>& values) {
  TileValues<Verdict> seen = values;
  std::replace(seen.begin(), seen.end(), Verdict::kUndecided, Verdict::kOutside);
  cut_zones(*tile.studies->zone, tile.eye(), tile.work.targets(), tile.progress, seen);
  std::transform(values.begin(), values.end(), seen.begin(), values.begin(),
                 [](Verdict line, Verdict with_zone) { return with_zone == Verdict::kZoneCut ? with_zone : line; });
}

}  // namespace itin::viewshed
