#include <algorithm>

#include <itin/store.hpp>
#include <profile/clearance_error.hpp>

namespace itin::profile {

double clearance_error(const Store& store, const Detail& detail, const ThemeChoice& themes, Point2 from, Point2 to) {
  const std::vector<LevelInfo>& levels = store.metadata().levels;
  Box box;
  box.extend(from);
  box.extend(to);
  CertifiedError widest;
  int finest = 0;
  for (std::size_t i = 0; i < levels.size() && levels[i].tolerance <= detail.coarsest(); ++i) {
    if (levels[i].tolerance <= detail.finest()) finest = static_cast<int>(i);
    if (i == 0) continue;  // the full surface itself
    const auto error = store.certified_error(static_cast<int>(i), box);
    if (!error) continue;
    widest.lo = std::min(widest.lo, error->lo), widest.hi = std::max(widest.hi, error->hi);
  }
  return widest.hi - widest.lo + store.greatest_height_left_out(themes, finest, box);
}

}  // namespace itin::profile
