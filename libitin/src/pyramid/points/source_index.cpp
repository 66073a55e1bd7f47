#include "pyramid/points/source_index.hpp"

#include <algorithm>

namespace itin {

SourceIndex::SourceIndex(const WorkingIndex& base, const Sources& sources)
    : base_(base), sources_(sources), points_(base.ranges().size(), 0) {
  for (std::size_t leaf = 0; leaf < points_.size(); ++leaf) {
    for (const RawPoint& p : base.read(base.ranges()[leaf])) {
      if (p.level == kDropped || !sources.contains(p.source)) continue;
      points_[leaf] += 1;
      bounds_.extend(morton_x(p.code), morton_y(p.code));
    }
  }
}

void SourceIndex::leaves(const LevelRange& asked, const GridBox& box, std::vector<Leaf>& out) const {
  const auto first = static_cast<std::ptrdiff_t>(out.size());
  base_.leaves(asked, box, out);
  out.erase(std::remove_if(out.begin() + first, out.end(), [&](const Leaf& leaf) { return points_[leaf.key] == 0; }),
            out.end());
  for (auto leaf = out.begin() + first; leaf != out.end(); ++leaf) leaf->points = points_[leaf->key];
}

std::shared_ptr<const Block> SourceIndex::block(const Leaf& leaf) const {
  const auto all = base_.block(leaf);
  auto block = std::make_shared<Block>();
  for (std::size_t i = 0; i < all->points.size(); ++i) {
    if (!sources_.contains(all->sources[i])) continue;
    block->points.push_back(all->points[i]);
    block->sources.add(all->sources[i]);
    block->levels.push_back(all->levels[i]);
  }
  return block;
}

}  // namespace itin
