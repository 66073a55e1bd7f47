// An index whose blocks are read, and counted, once, however often they are asked for.
#pragma once

#include <memory>
#include <vector>

#include "store/codec/point_index.hpp"
#include "triangulate/apex/block_reader.hpp"

namespace itin {

/// Reads blocks once and keeps them. Serves one thread, unlike other indices.
class ReadOnce final : public PointIndex {
 public:
  explicit ReadOnce(const PointIndex& base) : base_(base), blocks_(base) {}

  int level_count() const override { return base_.level_count(); }
  GridBox bounds() const override { return base_.bounds(); }
  void leaves(const LevelRange& asked, const GridBox& box, std::vector<Leaf>& out) const override {
    base_.leaves(asked, box, out);
  }
  std::shared_ptr<const Block> block(const Leaf& leaf) const override { return blocks_.read(leaf); }
  std::shared_ptr<const Block> unordered_block(const Leaf& leaf) const override { return blocks_.read_unordered(leaf); }
  PostLattice lattice_of(const Leaf& leaf) const override { return base_.lattice_of(leaf); }
  void segments(const GridBox& box, std::vector<Segment>& out) const override { base_.segments(box, out); }
  void outline(const GridBox& box, std::vector<Segment>& out) const override { base_.outline(box, out); }

  bool has_read(const Leaf& leaf) const { return blocks_.has_read(leaf); }
  const RetrievalStatistics& statistics() const { return blocks_.statistics(); }

 private:
  const PointIndex& base_;
  mutable BlockReader blocks_;
};

}  // namespace itin
