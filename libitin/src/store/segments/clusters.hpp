// Clusters: features that touch, so that a query has all of them or none. A query has a cluster where the finest level
// that it asks for anywhere in the cluster's box is at most the coarsest level of the cluster's part. Each leaf of a
// part has the boxes of the clusters that its items belong to. FORMAT.md describes the bytes.
//
//   const LeafClusters clusters = decode_clusters(leaf.cell, extents_of(block), bytes);
//   for (const auto& [item, cluster] : clusters.items) use(item, clusters.boxes[cluster]);
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "geometry/cell.hpp"
#include "store/codec/point_index.hpp"
#include "store/segments/segment_features.hpp"

namespace itin {

/// Stands for a cluster's number where a query with the part has the item in any case.
inline constexpr std::uint32_t kNoCluster = kNoFeature;

/// Says that an item of a leaf belongs to a cluster, each by its number.
struct ItemCluster {
  std::uint32_t item = 0, cluster = 0;
  friend auto operator<=>(const ItemCluster&, const ItemCluster&) = default;
};

/// The clusters of one leaf. Clusters that share their box count as one.
struct LeafClusters {
  std::vector<GridBox> boxes;      ///< ascending by xmin, ymin, xmax, ymax; each is the box of some item's cluster
  std::vector<ItemCluster> items;  ///< ascending; each item belongs to one cluster or more
};

/// The clusters of one part, and their members.
struct PartClusters {
  std::vector<GridBox> boxes;  ///< by number, as box_about_cluster() gives them
  /// The clusters of places, as (Morton code, cluster), ascending: of vertices, and of places where others make way.
  std::vector<std::pair<std::uint64_t, std::uint32_t>> of_places;
  std::vector<SegmentFeature> of_segments;  ///< the segments of clusters, ascending; `feature` is the cluster

  bool empty() const { return boxes.empty(); }
  LeafClusters of(std::span<const GridPoint> points) const;
  LeafClusters of(std::span<const Segment> segments) const;
};

/// Returns the box widened to whole steps, in which clusters' boxes are stored.
GridBox box_about_cluster(const GridBox& box);

/// Returns the boxes of a leaf's items.
std::vector<GridBox> extents_of(std::span<const GridPoint> points);
std::vector<GridBox> extents_of(std::span<const Segment> segments);

/// Encodes the clusters of a leaf. Precondition: every item meets the boxes of its clusters.
std::vector<std::uint8_t> encode_clusters(const Cell& cell, std::span<const GridBox> extents,
                                          const LeafClusters& clusters);
/// Decodes the clusters of a leaf. Throws DecodeError unless the bytes are the clusters of just these items.
LeafClusters decode_clusters(const Cell& cell, std::span<const GridBox> extents, std::span<const std::uint8_t> bytes);

}  // namespace itin
