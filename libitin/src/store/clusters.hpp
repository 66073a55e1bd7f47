// Clusters: features that touch, of which a query has all or none. It has a cluster where the finest level that it asks
// for anywhere in the cluster's box is at most the coarsest of its part. Each leaf of a part has the boxes of the
// clusters that its items are of. FORMAT.md writes the bytes down.
//
//   const LeafClusters clusters = decode_clusters(leaf.cell, extents_of(block), bytes);
//   for (const auto& [item, cluster] : clusters.items) use(item, clusters.boxes[cluster]);
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "geometry/cell.hpp"
#include "store/point_index.hpp"
#include "store/segment_features.hpp"

namespace itin {

/// In place of a cluster's number: a query with the part has it in any case.
inline constexpr std::uint32_t kNoCluster = kNoFeature;

/// An item of a leaf is of a cluster, each by its number.
struct ItemCluster {
  std::uint32_t item = 0, cluster = 0;
  friend auto operator<=>(const ItemCluster&, const ItemCluster&) = default;
};

/// The clusters of one leaf. Clusters that share their box count as one.
struct LeafClusters {
  std::vector<GridBox> boxes;      ///< ascending by xmin, ymin, xmax, ymax; each about some item
  std::vector<ItemCluster> items;  ///< ascending; each item is of one cluster or more
};

/// The clusters of one part, and what is of them.
struct PartClusters {
  std::vector<GridBox> boxes;  ///< by number, as box_about_cluster() gives them
  /// By Morton code, ascending: of vertices, and of places where others make way.
  std::vector<std::pair<std::uint64_t, std::uint32_t>> of_places;
  std::vector<SegmentFeature> of_segments;  ///< the cluster in place of a feature; ascending

  bool empty() const { return boxes.empty(); }
  LeafClusters of(std::span<const GridPoint> points) const;
  LeafClusters of(std::span<const Segment> segments) const;
};

/// A box widened to whole steps of what clusters' boxes are stored in.
GridBox box_about_cluster(const GridBox& box);

/// The boxes of a leaf's items.
std::vector<GridBox> extents_of(std::span<const GridPoint> points);
std::vector<GridBox> extents_of(std::span<const Segment> segments);

/// Precondition: every item meets the boxes that it is of.
std::vector<std::uint8_t> encode_clusters(const Cell& cell, std::span<const GridBox> extents,
                                          const LeafClusters& clusters);
/// Throws DecodeError unless the bytes are the clusters of just these items.
LeafClusters decode_clusters(const Cell& cell, std::span<const GridBox> extents, std::span<const std::uint8_t> bytes);

}  // namespace itin
