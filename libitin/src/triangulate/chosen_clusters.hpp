// The parts of a store's leaves that belong to the clusters that a query has.
//
//   const ChosenClusters chosen(store, selection);
//   chosen.block(leaf);                       // as the store's, without points of other clusters
//   chosen.segments(theme, box, segments);    // as the store's, without those of other clusters
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <itin/store.hpp>

#include "store/file/block_cache.hpp"
#include "store/segments/clusters.hpp"
#include "store/store_file.hpp"
#include "triangulate/apex/selection.hpp"

namespace itin {

/// Reads a store's leaves without other clusters. Safe for concurrent use. Refers to the store, which must outlive it.
class ChosenClusters {
 public:
  ChosenClusters(const Store& store, const Selection& selection);

  /// Returns the leaf's block, with the positions where others make way.
  std::shared_ptr<const Block> block(const Leaf& leaf) const;
  /// Appends the segments of a theme or part that meet the box, with the entries of the segments that make way for it,
  /// and perhaps others nearby. A segment may come twice.
  void segments(std::uint16_t theme, const GridBox& box, std::vector<Segment>& out) const;

 private:
  static constexpr int kWhole = -1;
  /// Returns the coarsest level of a part of which the query may have some clusters without others; kWhole otherwise.
  int coarsest(std::uint16_t theme) const { return coarsest_[theme]; }
  std::vector<bool> chosen_items(const LeafClusters& clusters, std::size_t items, int coarsest) const;
  std::shared_ptr<const std::vector<Segment>> segments_of(const Leaf& leaf, int coarsest) const;

  const StoreFile& file_;
  Selection selection_;
  std::vector<int> coarsest_;  ///< by number of theme or part
  mutable BlockCache cache_;
};

}  // namespace itin
