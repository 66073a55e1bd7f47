#include "pyramid/part_masks.hpp"

#include <algorithm>
#include <span>
#include <utility>

#include <itin/parallel.hpp>
#include <itin/sort_unique.hpp>

#include "features/plan/mask_index.hpp"
#include "store/codec/store_format.hpp"

namespace itin {

namespace {

using Codes = std::vector<std::uint64_t>;

bool among(const Codes& ascending, std::uint64_t code) {
  return std::binary_search(ascending.begin(), ascending.end(), code);
}

/// One part as it is written to the store.
class PartMask {
 public:
  /// `clusters` holds what the part's lines tell about them.
  PartMask(const PlacedPart& part, PartClusters clusters)
      : part_(part), index_(part.masks), clusters_(std::move(clusters)) {
    for (const PartVertex& v : part.vertices) own_.push_back(code_of(v.point));
  }

  int rank() const { return part_.rank; }
  bool has_clusters() const { return !part_.mask_clusters.empty() && part_.mask_clusters.front() != kNoCluster; }
  bool covers(std::uint64_t code) const { return index_.at(position_of(code)).has_value() && !among(own_, code); }
  /// Adds masked positions, in any order; they may repeat.
  void add(std::span<const std::uint64_t> codes) { masked_.insert(masked_.end(), codes.begin(), codes.end()); }
  void finish() {
    sort_unique(masked_);
    if (has_clusters()) find_places();
  }
  /// Adds a segment that makes way for the part to those of the cluster.
  void add_masked_for(const Segment& entry, std::uint32_t cluster) {
    if (has_clusters()) clusters_.of_segments.push_back({entry, cluster});
  }
  /// Adds a segment that makes way for the part to those of its clusters; `ground` tells whether it keeps the ground.
  void add_masked(const Segment& entry, bool ground) {
    if (!has_clusters()) return;
    for (const std::uint64_t end : {code_of(entry.a()), code_of(entry.b())})
      if (among(masked_, end)) add_masked_for(entry, cluster_about(end));
    if (ground) return;
    const auto about = index_.about_middle(entry.a(), entry.b());
    if (about) add_masked_for(entry, part_.mask_clusters[*about]);
  }
  PartClusters take_clusters() && {
    std::vector<SegmentFeature>& segments = clusters_.of_segments;
    sort_unique(segments);
    return std::move(clusters_);
  }
  /// Tells whether the part covers a segment. Lines end at feet, so a segment lies inside or outside as a whole.
  bool covers(const Segment& s) const { return hides_end(s) || index_.middle_inside(s.a(), s.b()); }
  /// Tells whether an end of the segment is masked. A line that keeps the ground makes way only in that case: between
  /// vertices that rise it keeps tops above the ground.
  bool hides_end(const Segment& s) const { return among(masked_, code_of(s.a())) || among(masked_, code_of(s.b())); }

  void write(std::uint16_t number, StoreWriter& writer) const {
    std::vector<std::pair<GridPoint, std::uint16_t>> entries;
    for (const PartVertex& v : part_.vertices) {
      const auto mark = static_cast<std::uint16_t>(v.outline ? format::kOnOutline : 0);
      entries.emplace_back(v.point, static_cast<std::uint16_t>(part_.source | mark));
    }
    // Masks have no height; a height near those of vertices takes the least room.
    const std::int32_t z = part_.vertices.front().point.z;
    for (const std::uint64_t code : masked_)
      entries.emplace_back(GridPoint{morton_x(code), morton_y(code), z}, format::kMask);
    std::sort(entries.begin(), entries.end(),
              [](const auto& a, const auto& b) { return code_of(a.first) < code_of(b.first); });
    std::vector<GridPoint> points;
    std::vector<std::uint16_t> sources;
    for (const auto& [point, source] : entries) {
      points.push_back(point);
      sources.push_back(source);
    }
    writer.add_part_vertices(number, points, sources, part_.reaches, clusters_);
  }

 private:
  using Place = std::pair<std::uint64_t, std::uint32_t>;  // code, cluster

  /// The cluster of the mask that has the position.
  std::uint32_t cluster_about(std::uint64_t code) const {
    return part_.mask_clusters[index_.at(position_of(code)).value()];
  }

  /// The clusters of all vertices and masked positions, and the boxes about these.
  void find_places() {
    std::vector<Place>& places = clusters_.of_places;
    sort_unique(places);
    const auto known = [&, of_lines = places.size()](std::uint64_t code) {
      const auto last = places.begin() + static_cast<std::ptrdiff_t>(of_lines);
      const auto at = std::lower_bound(places.begin(), last, Place{code, 0});
      return at != last && at->first == code;
    };
    std::vector<Place> others;
    for (const std::uint64_t code : own_)
      if (!known(code)) others.emplace_back(code, cluster_about(code));
    for (const std::uint64_t code : masked_) others.emplace_back(code, cluster_about(code));
    places.insert(places.end(), others.begin(), others.end());
    std::sort(places.begin(), places.end());
    for (const auto& [code, cluster] : places) {
      if (clusters_.boxes.size() <= cluster) clusters_.boxes.resize(cluster + std::size_t{1});
      clusters_.boxes[cluster].extend(morton_x(code), morton_y(code));
    }
    for (GridBox& box : clusters_.boxes)
      if (!box.empty()) box = box_about_cluster(box);
  }

  const PlacedPart& part_;
  MaskIndex index_;
  Codes own_, masked_;
  PartClusters clusters_;
};

/// The places and segments of each part's clusters that lines tell, by part.
std::vector<PartClusters> clusters_of_lines(const ThemeLines& lines) {
  std::vector<PartClusters> clusters(lines.parts.size());
  for (const auto& [edge, cluster] : lines.lines.features) {
    const PlanarEdge& e = lines.lines.edges[edge];
    if (!lines.is_raised(e)) continue;
    PartClusters& of_part = clusters[e.owner - lines.themes()];
    for (const std::uint32_t v : {e.from, e.to})
      of_part.of_places.emplace_back(code_of(lines.lines.vertices[v]), cluster);
    of_part.of_segments.push_back({raised_segment(e, lines), cluster});
  }
  return clusters;
}

/// The ground's leaves under the masks of all parts, each once.
std::vector<Leaf> leaves_under_masks(const std::vector<PlacedPart>& parts, const PointIndex& ground) {
  std::vector<Leaf> leaves;
  for (const PlacedPart& part : parts)
    for (const GridPolygon& mask : part.masks) ground.leaves({}, box_about(mask), leaves);
  std::sort(leaves.begin(), leaves.end(), [](const Leaf& a, const Leaf& b) { return a.key < b.key; });
  leaves.erase(std::unique(leaves.begin(), leaves.end(), [](const Leaf& a, const Leaf& b) { return a.key == b.key; }),
               leaves.end());
  return leaves;
}

void mask_terrain(std::vector<PartMask>& parts, const std::vector<Leaf>& leaves, const PointIndex& ground,
                  Progress& progress) {
  std::vector<std::vector<Codes>> found(leaves.size(), std::vector<Codes>(parts.size()));
  parallel_for(leaves.size(), [&](std::size_t n) {
    progress.throw_if_cancelled();
    const auto block = ground.block_once(leaves[n]);
    for (const GridPoint& p : block->points)
      for (std::size_t i = 0; i < parts.size(); ++i)
        if (parts[i].covers(code_of(p))) found[n][i].push_back(code_of(p));
  });
  for (const auto& of_leaf : found)
    for (std::size_t i = 0; i < parts.size(); ++i) parts[i].add(of_leaf[i]);
}

void mask_vertices(PartMask& part, const std::vector<GridPoint>& vertices) {
  Codes codes;
  for (const GridPoint& p : vertices)
    if (part.covers(code_of(p))) codes.push_back(code_of(p));
  part.add(codes);
}

std::vector<GridPoint> points_of(const PlacedPart& part) {
  std::vector<GridPoint> points;
  for (const PartVertex& v : part.vertices) points.push_back(v.point);
  return points;
}

}  // namespace

WrittenParts write_parts(const ThemeLines& lines, const PointIndex& ground, const std::vector<GridPoint>& draped,
                         const std::vector<Segment>& segments, StoreWriter& writer, Progress& progress) {
  WrittenParts written;
  std::vector<Segment>& masked = written.masked;
  if (lines.parts.empty()) return written;
  std::vector<PartClusters> clusters = clusters_of_lines(lines);
  std::vector<PartMask> parts;
  for (std::size_t i = 0; i < lines.parts.size(); ++i) parts.emplace_back(lines.parts[i], std::move(clusters[i]));
  mask_terrain(parts, leaves_under_masks(lines.parts, ground), ground, progress);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    mask_vertices(parts[i], draped);
    for (const PlacedPart& other : lines.parts)
      if (other.rank > parts[i].rank()) mask_vertices(parts[i], points_of(other));
    parts[i].finish();
    const auto number = static_cast<std::uint16_t>(lines.themes() + i + 1);
    parts[i].write(number, writer);
    for (const Segment& s : segments) {
      const bool lower = s.theme <= lines.themes() || parts[s.theme - lines.themes() - 1].rank() > parts[i].rank();
      if (s.theme == kCoverage || !lower) continue;
      const bool keeps_ground = s.theme <= lines.themes() && lines.raised[s.theme - std::size_t{1}];
      if (keeps_ground ? !parts[i].hides_end(s) : !parts[i].covers(s)) continue;
      masked.push_back({s.ax, s.ay, s.bx, s.by, number, format::kMaskedSegment, format::kMaskedSegment, s.theme});
      parts[i].add_masked(masked.back(), keeps_ground);
    }
  }
  for (const PlacedBorder& placed : lines.borders) {
    const Segment s = segment_of(placed.border);
    for (const auto& [owner, cluster] : placed.makes_way_for) {
      masked.push_back({s.ax, s.ay, s.bx, s.by, static_cast<std::uint16_t>(owner + 1), format::kMaskedSegment,
                        format::kMaskedSegment, s.theme});
      if (owner >= lines.themes()) parts[owner - lines.themes()].add_masked_for(masked.back(), cluster);
    }
  }
  sort_unique(masked);
  for (std::size_t i = 0; i < parts.size(); ++i)
    if (parts[i].has_clusters())
      written.clusters[static_cast<std::uint16_t>(lines.themes() + i + 1)] = std::move(parts[i]).take_clusters();
  return written;
}

}  // namespace itin
