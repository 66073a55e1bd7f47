// Reads an index's blocks for one search, each once, and counts what was read.
#pragma once

#include <cstdint>
#include <memory>
#include <unordered_map>

#include <itin/tin.hpp>

#include "store/codec/point_index.hpp"

namespace itin {

class BlockReader {
 public:
  explicit BlockReader(const PointIndex& index) : index_(index) {}

  std::shared_ptr<const Block> read(const Leaf& leaf) {
    std::shared_ptr<const Block>& block = blocks_[leaf.key];
    if (block == nullptr) {
      block = index_.block(leaf);
      count(*block);
    } else if (!block->in_order) {
      block = index_.block(leaf);
    }
    return block;
  }
  /// Reads a block whose points may be in any order, as with PointIndex::unordered_block().
  std::shared_ptr<const Block> read_unordered(const Leaf& leaf) {
    std::shared_ptr<const Block>& block = blocks_[leaf.key];
    if (block == nullptr) {
      block = index_.unordered_block(leaf);
      count(*block);
    }
    return block;
  }
  bool has_read(const Leaf& leaf) const { return blocks_.contains(leaf.key); }
  const RetrievalStatistics& statistics() const { return statistics_; }

 private:
  void count(const Block& block) {
    statistics_.points_read += block.points.size();
    statistics_.blocks_read += 1;
  }

  const PointIndex& index_;
  RetrievalStatistics statistics_;
  /// The blocks read so far: searches about one place come back to the same few leaves.
  std::unordered_map<std::uint64_t, std::shared_ptr<const Block>> blocks_;
};

}  // namespace itin
