#include "store/cluster_check.hpp"

#include <algorithm>
#include <array>
#include <map>

#include "store/codec/store_format.hpp"

namespace itin {

namespace {

using Boxes = std::vector<GridBox>;

/// The boxes of the clusters that the vertices of one part belong to.
class VertexBoxes {
 public:
  VertexBoxes(const StoreFile& file, std::uint16_t part) : file_(file), tree_(format::vertex_tree(part)) {}

  bool has(std::int32_t x, std::int32_t y, const GridBox& box) {
    std::vector<Leaf> leaves;
    file_.leaves_of(tree_, {x, y, x, y}, leaves);
    if (leaves.empty() || leaves.front().points == 0) return false;
    if (leaves.front().key != key_) read(leaves.front());
    const auto found = boxes_.find(morton(x, y));
    return found != boxes_.end() && std::find(found->second.begin(), found->second.end(), box) != found->second.end();
  }

 private:
  void read(const Leaf& leaf) {
    const std::shared_ptr<const Block> block = file_.block(leaf);
    const LeafClusters clusters = file_.read_clusters(leaf, extents_of(block->points));
    boxes_.clear();
    for (const auto& [item, cluster] : clusters.items)
      boxes_[code_of(block->points[item])].push_back(clusters.boxes[cluster]);
    key_ = leaf.key;
  }

  const StoreFile& file_;
  int tree_;
  std::uint64_t key_ = 0;  ///< the leaf that was read last
  std::map<std::uint64_t, Boxes> boxes_;
};

bool agree(const StoreFile& file, const Leaf& leaf, VertexBoxes& vertices) {
  const std::vector<Segment> segments = file.read_edges(leaf);
  const LeafClusters clusters = file.read_clusters(leaf, extents_of(segments));
  return std::all_of(clusters.items.begin(), clusters.items.end(), [&](const ItemCluster& of) {
    const Segment& s = segments[of.item];
    const GridBox& box = clusters.boxes[of.cluster];
    return s.finest == format::kMaskedSegment || (vertices.has(s.ax, s.ay, box) && vertices.has(s.bx, s.by, box));
  });
}

}  // namespace

std::vector<Damage> false_clusters(const StoreFile& file, const Progress& progress) {
  std::vector<Damage> damage;
  const StoreMetadata& metadata = file.metadata();
  for (std::size_t p = 0; p < metadata.parts.size(); ++p) {
    const auto number = static_cast<std::uint16_t>(metadata.themes.size() + p + 1);
    if (!metadata.parts[p].has_clusters) continue;
    VertexBoxes vertices(file, number);
    file.for_each_leaf_of(format::edge_tree(number), [&](const Leaf& leaf) {
      progress.throw_if_cancelled();
      if (!agree(file, leaf, vertices))
        damage.push_back(
            {format::place("block", leaf.key), "has a segment whose ends are not of its cluster of features"});
    });
  }
  return damage;
}

}  // namespace itin
