#include <memory>

#include <itin/sources_in.hpp>

#include "store/codec/point_index.hpp"
#include "store/codec/store_format.hpp"

namespace itin {

namespace {

/// Returns the theme of a leaf's points, from 1; 0: terrain. The parts of raised themes are numbered after the themes.
std::size_t theme_of(const Leaf& leaf, const StoreMetadata& metadata) {
  const std::size_t themes = metadata.themes.size();
  return leaf.theme <= themes ? leaf.theme : metadata.parts[leaf.theme - themes - 1].theme;
}

}  // namespace

std::vector<SourceInfo> sources_in(const Store& store, const Box& box, const ThemeChoice& themes) {
  const StoreMetadata& metadata = store.metadata();
  const GridBox within = metadata.grid.enclosing(box);
  if (metadata.sources.size() == 1 && within.meets(metadata.bounds)) return metadata.sources;
  std::vector<Leaf> leaves;
  store.points().leaves({}, within, leaves);
  std::vector<bool> found(metadata.sources.size());
  std::size_t left = found.size();
  for (const Leaf& leaf : leaves) {
    if (left == 0) break;
    const std::size_t theme = theme_of(leaf, metadata);
    if (theme > 0 && !themes.includes(metadata.themes[theme - 1])) continue;
    const std::shared_ptr<const Block> block = store.points().block(leaf);
    const bool part = leaf.theme > metadata.themes.size();
    for (std::size_t i = 0; i < block->points.size(); ++i) {
      if (part && block->sources[i] == format::kMask) continue;
      const std::size_t source = part ? block->sources[i] & ~format::kOnOutline : block->sources[i];
      if (found[source] || !within.contains(block->points[i].x, block->points[i].y)) continue;
      found[source] = true, --left;
    }
  }
  std::vector<SourceInfo> sources;
  for (std::size_t s = 0; s < found.size(); ++s)
    if (found[s]) sources.push_back(metadata.sources[s]);
  return sources;
}

}  // namespace itin
