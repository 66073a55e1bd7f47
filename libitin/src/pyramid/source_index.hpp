// The points of some sources only, without any lines.
#pragma once

#include <cstdint>
#include <memory>
#include <set>
#include <vector>

#include "store/point_index.hpp"

namespace itin {

using Sources = std::set<std::uint16_t>;

class SourceIndex final : public PointIndex {
 public:
  /// Both must outlive it.
  SourceIndex(const PointIndex& base, const Sources& sources) : base_(base), sources_(sources) {}
  int level_count() const override { return base_.level_count(); }
  GridBox bounds() const override { return base_.bounds(); }
  void leaves(int finest, const GridBox& box, std::vector<Leaf>& out) const override { base_.leaves(finest, box, out); }
  void segments(const GridBox&, std::vector<Segment>&) const override {}
  std::shared_ptr<const Block> block(const Leaf& leaf) const override {
    const auto all = base_.block(leaf);
    auto block = std::make_shared<Block>();
    for (std::size_t i = 0; i < all->points.size(); ++i) {
      if (!sources_.contains(all->sources[i])) continue;
      block->points.push_back(all->points[i]);
      block->sources.push_back(all->sources[i]);
      block->levels.push_back(all->levels[i]);
    }
    return block;
  }

 private:
  const PointIndex& base_;
  const Sources& sources_;
};

}  // namespace itin
