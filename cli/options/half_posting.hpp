// The finest cells that show more of the ground than its posts tell.
#pragma once

#include <algorithm>
#include <optional>

#include <itin/store.hpp>
#include <itin/theme.hpp>

namespace itin::cli {

/// Returns the least distance of posts of the store's terrain, metres; nothing where it is not known.
inline std::optional<double> least_spacing(const StoreMetadata& metadata) {
  std::optional<double> least;
  for (const SourceInfo& source : metadata.sources)
    if (source.theme.empty() && source.spacing > 0) least = std::min(least.value_or(source.spacing), source.spacing);
  return least;
}

/// Returns half the least distance of posts of the store's terrain; 0 where features stand on it, whose edges are finer
/// than posts, or where the distance is not known.
inline double half_posting(const StoreMetadata& metadata, const ThemeChoice& themes) {
  if (themes.includes_raised(metadata.themes)) return 0;
  return least_spacing(metadata).value_or(0) / 2;
}

}  // namespace itin::cli
