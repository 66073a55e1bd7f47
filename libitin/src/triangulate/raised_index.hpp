// A store's vertices and lines, including the chosen raised features and leaving out what makes way for them.
//
//   const RaisedIndex index(store, selection);     // then as any PointIndex, with the same selection
//
// The points present depend on the selection alone, never on the window, so that everything that holds for a store's
// triangulations holds for these.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include <itin/store.hpp>

#include "store/codec/point_index.hpp"
#include "store/file/block_cache.hpp"
#include "triangulate/apex/selection.hpp"
#include "triangulate/chosen_clusters.hpp"
#include "triangulate/ground_beneath.hpp"

namespace itin {

/// An index of a store's surface with raised features. Safe for concurrent use. Refers to the store, which must outlive
/// it.
class RaisedIndex final : public PointIndex {
 public:
  RaisedIndex(const Store& store, const Selection& selection);

  int level_count() const override { return base_.level_count(); }
  GridBox bounds() const override { return base_.bounds(); }
  void leaves(const LevelRange& asked, const GridBox& box, std::vector<Leaf>& out) const override {
    base_.leaves(asked, box, out);
  }
  std::shared_ptr<const Block> block(const Leaf& leaf) const override;
  std::shared_ptr<const Block> unordered_block(const Leaf& leaf) const override {
    return any_ ? block(leaf) : base_.unordered_block(leaf);
  }
  std::shared_ptr<const Block> block_once(const Leaf& leaf) const override {
    return any_ ? block(leaf) : base_.block_once(leaf);
  }
  std::shared_ptr<const Block> plan_once(const Leaf& leaf) const override {
    return any_ ? block(leaf) : base_.plan_once(leaf);
  }
  PostLattice lattice_of(const Leaf& leaf) const override { return base_.lattice_of(leaf); }
  std::optional<PostHeights> posts_once(const Leaf& leaf) const override {
    return any_ ? std::nullopt : base_.posts_once(leaf);
  }
  void segments(const GridBox& box, std::vector<Segment>& out) const override;
  /// No feature makes the outline make way.
  void outline(const GridBox& box, std::vector<Segment>& out) const override { base_.outline(box, out); }

  /// Tells whether features are chosen, for which vertices of the store make way.
  bool any_raised() const { return any_; }

 private:
  static constexpr int kNotThere = -1;
  /// Returns the rank of the theme or part of this number, kNotThere where it is not chosen. Themes on the ground and
  /// the terrain come after all parts.
  int rank(std::uint16_t theme) const { return ranks_[theme]; }
  bool is_part(std::uint16_t theme) const { return theme > themes_; }
  std::vector<std::uint64_t> masks(const GridBox& box, int below) const;

  const PointIndex& base_;
  ChosenClusters chosen_;
  std::size_t themes_;
  std::vector<int> ranks_;  ///< by number of theme or part
  std::vector<std::uint16_t> themes_of_parts_;
  bool any_ = false;                              ///< whether some part is chosen
  std::shared_ptr<const GroundBeneath> beneath_;  ///< in place of features that are left out; null: none are
  mutable BlockCache cache_;
};

}  // namespace itin
