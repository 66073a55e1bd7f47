// The finest cells that show more of the ground than its posts tell.
#pragma once

#include <algorithm>
#include <limits>

#include <itin/store.hpp>
#include <itin/theme.hpp>

namespace itin::cli {

/// Returns half the least distance of posts of the store's terrain; 0 where features stand on it, whose edges are finer
/// than posts, or where the distance is not known.
inline double half_posting(const StoreMetadata& metadata, const ThemeChoice& themes) {
  if (themes.includes_raised(metadata.themes)) return 0;
  double least = std::numeric_limits<double>::infinity();
  for (const SourceInfo& source : metadata.sources)
    if (source.theme.empty() && source.spacing > 0) least = std::min(least, source.spacing);
  return least < std::numeric_limits<double>::infinity() ? least / 2 : 0;
}

}  // namespace itin::cli
