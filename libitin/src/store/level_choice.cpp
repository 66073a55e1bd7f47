#include <algorithm>

#include <itin/level_choice.hpp>

namespace itin {

namespace {

int coarsest_of(const StoreMetadata& metadata) {
  return static_cast<int>(metadata.levels.size()) - 1;
}

}  // namespace

int level_within(const StoreMetadata& metadata, double tolerance) {
  int level = 0;
  while (level < coarsest_of(metadata) && metadata.levels[static_cast<std::size_t>(level) + 1].tolerance <= tolerance)
    ++level;
  return level;
}

int finest_level_of(const Store& store, const Box& box, std::uint64_t most_points, int finest) {
  int level = finest;
  while (level < coarsest_of(store.metadata()) && store.points_about(level, box) > most_points) ++level;
  return level;
}

Detail detail_of(const StoreMetadata& metadata, int level) {
  return Detail::tolerance(metadata.levels[static_cast<std::size_t>(level)].tolerance);
}

CertifiedError certified_error(const StoreMetadata& metadata, const Detail& detail) {
  CertifiedError widest;
  for (const Ring& ring : detail.rings()) {
    const LevelInfo& level = metadata.levels[static_cast<std::size_t>(level_within(metadata, ring.tolerance))];
    widest.lo = std::min(widest.lo, level.certified_error.lo);
    widest.hi = std::max(widest.hi, level.certified_error.hi);
  }
  return widest;
}

}  // namespace itin
