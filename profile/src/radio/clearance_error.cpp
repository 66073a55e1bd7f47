#include <algorithm>

#include <itin/feature_cuts.hpp>
#include <itin/level_choice.hpp>
#include <itin/store.hpp>
#include <profile/clearance_error.hpp>

namespace itin::profile {

double clearance_error(const Store& store, const Detail& detail, const ThemeChoice& themes, Point2 from, Point2 to) {
  const int coarsest = level_within(store.metadata(), detail.coarsest());
  Box box;
  box.extend(from);
  box.extend(to);
  CertifiedError widest;
  // Level 0 is the full surface itself.
  for (int level = 1; level <= coarsest; ++level) {
    const auto error = store.certified_error(level, box);
    if (!error) continue;
    widest.lo = std::min(widest.lo, error->lo), widest.hi = std::max(widest.hi, error->hi);
  }
  // Flat foundations cut otherwise into coarse ground.
  const Grid& grid = store.metadata().grid;
  const std::int32_t cut = coarsest > 0 ? deepest_cut(feature_cuts(store, themes, box), grid.enclosing(box)) : 0;
  return widest.hi - widest.lo + store.greatest_height_left_out(themes, coarsest, box) + cut * grid.resolution;
}

}  // namespace itin::profile
