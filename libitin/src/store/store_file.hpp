// An open store: its quadtrees, read through the cache.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <itin/certificate.hpp>
#include <itin/store.hpp>

#include "geometry/morton_range.hpp"
#include "store/codec/block_codec.hpp"
#include "store/codec/point_index.hpp"
#include "store/feature_table.hpp"
#include "store/file/block_cache.hpp"
#include "store/file/directory.hpp"
#include "store/file/store_rows.hpp"
#include "store/segments/clusters.hpp"
#include "store/segments/footprint_codec.hpp"
#include "store/segments/segment_features.hpp"

namespace itin {

class StoreFile final : public PointIndex {
 public:
  StoreFile(const std::string& path, const StoreOptions& options);

  int level_count() const override { return static_cast<int>(metadata_.levels.size()); }
  GridBox bounds() const override { return metadata_.bounds; }
  void leaves(const LevelRange& asked, const GridBox& box, std::vector<Leaf>& out) const override;
  std::shared_ptr<const Block> block(const Leaf& leaf) const override;
  std::shared_ptr<const Block> unordered_block(const Leaf& leaf) const override;
  std::shared_ptr<const Block> block_once(const Leaf& leaf) const override;
  std::shared_ptr<const Block> plan_once(const Leaf& leaf) const override;
  PostLattice lattice_of(const Leaf& leaf) const override;
  std::optional<PostHeights> posts_once(const Leaf& leaf) const override;
  void segments(const GridBox& box, std::vector<Segment>& out) const override;
  void outline(const GridBox& box, std::vector<Segment>& out) const override;

  /// Appends every leaf of one tree that meets the box, empty ones too, along the curve.
  void leaves_of(int tree, const GridBox& box, std::vector<Leaf>& out) const;
  /// Appends segments as segments() does, of one tree.
  void segments_of(int tree, const GridBox& box, std::vector<Segment>& out) const;

  /// Calls visit(leaf) for every leaf of one tree, empty ones too.
  template <typename Visit>
  void for_each_leaf_of(int tree, const Visit& visit) const;

  /// Reads one of the theme's footprint blocks.
  std::vector<StoredFootprint> read_footprints(std::uint16_t theme, std::uint32_t number) const;
  /// Reads one of the theme's feature blocks.
  std::vector<FeatureRecord> read_features(std::uint16_t theme, std::uint32_t number) const;
  /// Appends the features of the theme's segments that meet the box, and perhaps of others nearby. An entry may come
  /// twice.
  void segment_features(std::uint16_t theme, const GridBox& box, std::vector<SegmentFeature>& out) const;
  /// Returns the greatest height of the part's features about the box above the full surface, grid units; 0 where there
  /// are no features.
  std::int32_t greatest_height(std::uint16_t part, const GridBox& box) const;
  /// Returns the cells about the box where the part's features are lower than the full surface, along the curve.
  std::vector<Certificate::Cell> cuts(std::uint16_t part, const GridBox& box) const;
  std::optional<CertifiedError> certified_error(int level, const Box& box) const;
  std::uint64_t points_about(int level, const Box& box) const;
  Certificate certificate(int level, const Box& box) const;

  const StoreMetadata& metadata() const { return metadata_; }
  const StoreRows& rows() const { return rows_; }
  const ChunkList& chunks() const { return chunks_; }

  /// These read and decode, bypassing the cache.
  DirectoryChunk read_chunk(int tree, const ChunkEntry& entry) const;
  Block read_block(const Leaf& leaf, BlockOrder order = BlockOrder::kMorton) const;
  std::vector<Segment> read_edges(const Leaf& leaf) const;
  std::vector<SegmentFeature> read_segment_features(const Leaf& leaf) const;
  /// Reads the clusters of a leaf of a part that has clusters; `extents` are the boxes of the leaf's items.
  LeafClusters read_clusters(const Leaf& leaf, std::span<const GridBox> extents) const;
  /// Tells whether the theme or part of this number has clusters.
  bool has_clusters(std::uint16_t theme) const;

 private:
  static constexpr auto kSkipNone = [](const ChunkEntry&) { return false; };
  /// Calls visit(leaf) for every leaf of the tree, empty ones too, that meets the box, along the curve, except leaves
  /// of chunks for which skip(chunk) is true.
  template <typename Visit, typename Skip = decltype(kSkipNone)>
  void for_each_leaf(int tree, const GridBox& box, const Visit& visit, const Skip& skip = kSkipNone) const;
  std::shared_ptr<const Block> block(const Leaf& leaf, BlockOrder order) const;
  double share_of(int level) const;
  bool is_part_of_ground(const Leaf& leaf) const;
  Block read_ground(const Leaf& leaf, BlockOrder order) const;
  bool has_segment_features(std::uint16_t theme) const;
  std::shared_ptr<const DirectoryChunk> chunk(int tree, const ChunkEntry& entry) const;
  std::span<const std::uint8_t> items_of(std::uint64_t key, std::span<const std::uint8_t> bytes) const;

  StoreRows rows_;
  StoreMetadata metadata_;
  ChunkList chunks_;
  mutable BlockCache cache_;
};

template <typename Visit>
void StoreFile::for_each_leaf_of(int tree, const Visit& visit) const {
  const auto found = chunks_.find(tree);
  if (found == chunks_.end()) return;
  for (const ChunkEntry& entry : found->second)
    for (const Leaf& leaf : read_chunk(tree, entry)) visit(leaf);
}

/// Returns the file of an open store, for code that looks behind its public interface.
const StoreFile& file_of(const Store& store);

}  // namespace itin
