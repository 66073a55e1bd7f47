#include "store/store_file.hpp"

#include <algorithm>
#include <cmath>

#include <itin/error.hpp>

#include "store/codec/block_codec.hpp"
#include "store/codec/byte_stream.hpp"
#include "store/codec/store_format.hpp"
#include "store/metadata_json.hpp"
#include "store/segments/block_preface.hpp"
#include "store/segments/edge_quadtree.hpp"
#include "store/segments/line_codec.hpp"

namespace itin {

namespace {

StoreMetadata read_metadata(const StoreRows& rows) {
  try {
    return metadata_from_json(rows.read_metadata());
  } catch (const DecodeError& e) {
    throw CorruptStore(rows.path(), "metadata", e.what());
  }
}

// Blocks and chunks may have the same key, and share one cache.
std::uint64_t cache_key(BlobKind kind, std::uint64_t key) {
  return key << 1 | (kind == BlobKind::Directory ? 1 : 0);
}

}  // namespace

StoreFile::StoreFile(const std::string& path, const StoreOptions& options) : rows_(path), cache_(options.cache_bytes) {
  metadata_ = read_metadata(rows_);
  metadata_.format_version = rows_.version();
  chunks_ = decoded(rows_, BlobKind::Directory, format::kChunkListKey,
                    [](const auto& bytes) { return decode_chunk_list(bytes); });
}

DirectoryChunk StoreFile::read_chunk(int tree, const ChunkEntry& entry) const {
  return decoded(rows_, BlobKind::Directory, format::key(tree, entry.code),
                 [&](const auto& bytes) { return decode_chunk(bytes, tree, entry); });
}

Block StoreFile::read_block(const Leaf& leaf, BlockOrder order) const {
  if (is_part_of_ground(leaf)) return read_ground(leaf, order);
  return decoded(rows_, BlobKind::Block, leaf.key, [&](const auto& bytes) {
    Block block = decode_block(leaf.cell, items_of(leaf.key, bytes), order);
    const auto [low, high] = std::minmax_element(block.points.begin(), block.points.end(),
                                                 [](const GridPoint& a, const GridPoint& b) { return a.z < b.z; });
    if (block.points.size() != leaf.points || low->z != leaf.zmin || high->z != leaf.zmax) {
      throw DecodeError("does not agree with its directory");
    }
    if (format::tree_of(leaf.key) == format::kGroundTree && block.levels.empty())
      block.levels.assign(block.points.size(), 0);
    return block;
  });
}

/// Tells whether the leaf has those of the ground's vertices alone that are of the level of its key, or coarser.
bool StoreFile::is_part_of_ground(const Leaf& leaf) const {
  const int tree = format::tree_of(leaf.key);
  return tree != format::kGroundTree && tree < metadata_.fine_levels;
}

Block StoreFile::read_ground(const Leaf& leaf, BlockOrder order) const {
  return decoded(rows_, BlobKind::Block, format::key(format::kGroundTree, leaf.cell.code), [&](const auto& bytes) {
    if (decode_lattice(leaf.cell, bytes).points != leaf.points) throw DecodeError("does not agree with its directory");
    return decode_block(leaf.cell, bytes, order, format::tree_of(leaf.key));
  });
}

bool StoreFile::has_segment_features(std::uint16_t theme) const {
  return theme != kCoverage && theme <= metadata_.themes.size() &&
         metadata_.themes[theme - std::size_t{1}].segments_have_features;
}

bool StoreFile::has_clusters(std::uint16_t theme) const {
  const std::size_t themes = metadata_.themes.size();
  return theme > themes && theme <= themes + metadata_.parts.size() && metadata_.parts[theme - themes - 1].has_clusters;
}

/// Returns a leaf's block without its preface.
std::span<const std::uint8_t> StoreFile::items_of(std::uint64_t key, std::span<const std::uint8_t> bytes) const {
  const int tree = format::tree_of(key);
  const std::uint16_t theme = format::theme_of(tree);
  const bool prefaced = has_clusters(theme) || (format::is_edge_tree(tree) && has_segment_features(theme));
  return prefaced ? split(bytes).items : bytes;
}

std::vector<Segment> StoreFile::read_edges(const Leaf& leaf) const {
  return decoded(rows_, BlobKind::Block, leaf.key, [&](std::span<const std::uint8_t> bytes) {
    const std::uint16_t theme = format::theme_of(leaf.level);
    if (theme == kCoverage) return decode_outline(leaf.cell, leaf.points, bytes);
    return decode_lines(leaf.cell, theme, leaf.points, items_of(leaf.key, bytes));
  });
}

std::vector<SegmentFeature> StoreFile::read_segment_features(const Leaf& leaf) const {
  return decoded(rows_, BlobKind::Block, leaf.key, [&](std::span<const std::uint8_t> bytes) {
    const PrefacedBlock block = split(bytes);
    return decode_segment_features(decode_lines(leaf.cell, format::theme_of(leaf.level), leaf.points, block.items),
                                   block.preface);
  });
}

LeafClusters StoreFile::read_clusters(const Leaf& leaf, std::span<const GridBox> extents) const {
  return decoded(rows_, BlobKind::Block, leaf.key,
                 [&](const auto& bytes) { return decode_clusters(leaf.cell, extents, split(bytes).preface); });
}

void StoreFile::segment_features(std::uint16_t theme, const GridBox& box, std::vector<SegmentFeature>& out) const {
  if (!has_segment_features(theme)) return;
  for_each_leaf(format::edge_tree(theme), box, [&](const Leaf& leaf) {
    const std::vector<SegmentFeature> features = read_segment_features(leaf);
    out.insert(out.end(), features.begin(), features.end());
  });
}

std::shared_ptr<const DirectoryChunk> StoreFile::chunk(int tree, const ChunkEntry& entry) const {
  const std::uint64_t key = cache_key(BlobKind::Directory, format::key(tree, entry.code));
  if (auto cached = cache_.find(key)) return std::static_pointer_cast<const DirectoryChunk>(std::move(cached));
  auto chunk = std::make_shared<const DirectoryChunk>(read_chunk(tree, entry));
  cache_.insert(key, chunk, sizeof(DirectoryChunk) + chunk->size() * sizeof(Leaf));
  return chunk;
}

template <typename Visit, typename Skip>
void StoreFile::for_each_leaf(int tree, const GridBox& box, const Visit& visit, const Skip& skip) const {
  const auto found = chunks_.find(tree);
  if (found == chunks_.end() || !MortonRange::exists(box)) return;
  const std::vector<ChunkEntry>& entries = found->second;
  const MortonRange range(box);
  const auto ends_after = [](std::uint64_t code, const auto& e) { return code < e.end; };
  auto entry = entries.begin();
  for (std::optional<std::uint64_t> code = range.next(0); code;) {
    entry = std::upper_bound(entry, entries.end(), *code, ends_after);
    if (entry == entries.end()) return;
    if (entry->code > *code) code = range.next(entry->code);
    if (!code || *code >= entry->end) continue;
    if (skip(*entry)) {
      code = range.next(entry->end);
      continue;
    }
    const std::shared_ptr<const DirectoryChunk> leaves = chunk(tree, *entry);
    // Invariant: *code is in the box, and no leaf below it is left to visit.
    for (auto leaf = leaves->begin(); code && *code < entry->end;) {
      leaf =
          std::upper_bound(leaf, leaves->end(), *code, [](std::uint64_t c, const Leaf& l) { return c < l.cell.end(); });
      if (leaf->cell.code > *code) code = range.next(leaf->cell.code);
      if (!code || *code >= leaf->cell.end()) continue;
      visit(*leaf);
      code = range.next(leaf->cell.end());
    }
  }
}

/// Returns the share of the full surface's vertices that a level has.
double StoreFile::share_of(int level) const {
  double all = 0, there = 0;
  for (int k = 0; k < level_count(); ++k) {
    const auto vertices = static_cast<double>(metadata_.levels[static_cast<std::size_t>(k)].vertices);
    all += vertices;
    if (k >= level) there += vertices;
  }
  return all > 0 ? there / all : 1;
}

void StoreFile::leaves(const LevelRange& asked, const GridBox& box, std::vector<Leaf>& out) const {
  if (asked.finest < metadata_.fine_levels) {
    const double share = share_of(asked.finest);
    for_each_leaf(format::kGroundTree, box, [&](Leaf leaf) {
      if (leaf.points == 0) return;
      // Where one level is asked for everywhere, finer vertices are left out at once.
      if (asked.finest == asked.coarsest) leaf.key = format::key(asked.finest, leaf.cell.code);
      leaf.level = level_count() - 1;
      leaf.serves = {asked.finest == asked.coarsest ? asked.finest : 0, metadata_.fine_levels - 1};
      leaf.asked = static_cast<std::uint32_t>(std::ceil(leaf.points * share));
      out.push_back(leaf);
    });
  }
  const bool asks_for_coarse = asked.coarsest >= metadata_.fine_levels;
  for (int level = std::max(asked.finest, metadata_.fine_levels); asks_for_coarse && level < level_count(); ++level) {
    for_each_leaf(level, box, [&](Leaf leaf) {
      leaf.serves = {metadata_.fine_levels, level_count()};
      leaf.asked = leaf.points;
      if (leaf.points > 0) out.push_back(leaf);
    });
  }
  for (auto tree = chunks_.upper_bound(format::kMaxLevels); tree != chunks_.end(); ++tree) {
    if (format::is_edge_tree(tree->first)) break;
    for_each_leaf(tree->first, box, [&](Leaf leaf) {
      leaf.level = level_count() - 1;
      leaf.asked = leaf.points;
      leaf.theme = format::theme_of(tree->first);
      if (leaf.points > 0) out.push_back(leaf);
    });
  }
}

void StoreFile::leaves_of(int tree, const GridBox& box, std::vector<Leaf>& out) const {
  for_each_leaf(tree, box, [&](const Leaf& leaf) { out.push_back(leaf); });
}

std::shared_ptr<const Block> StoreFile::block(const Leaf& leaf, BlockOrder order) const {
  const std::uint64_t key = cache_key(BlobKind::Block, leaf.key);
  const auto cached = std::static_pointer_cast<const Block>(cache_.find(key));
  if (cached && (cached->in_order || order == BlockOrder::kAny)) return cached;
  if (cached) cache_.erase(key);
  auto block = std::make_shared<const Block>(read_block(leaf, order));
  cache_.insert(key, block, block->bytes());
  return block;
}

std::shared_ptr<const Block> StoreFile::block(const Leaf& leaf) const {
  return block(leaf, BlockOrder::kMorton);
}

std::shared_ptr<const Block> StoreFile::unordered_block(const Leaf& leaf) const {
  return block(leaf, BlockOrder::kAny);
}

std::shared_ptr<const Block> StoreFile::block_once(const Leaf& leaf) const {
  return std::make_shared<const Block>(read_block(leaf, BlockOrder::kAny));
}

std::shared_ptr<const Block> StoreFile::plan_once(const Leaf& leaf) const {
  if (is_part_of_ground(leaf)) return block_once(leaf);
  return decoded(rows_, BlobKind::Block, leaf.key, [&](const auto& bytes) {
    auto block = std::make_shared<const Block>(decode_plan(leaf.cell, items_of(leaf.key, bytes)));
    if (block->points.size() != leaf.points) throw DecodeError("does not agree with its directory");
    return block;
  });
}

PostLattice StoreFile::lattice_of(const Leaf& leaf) const {
  const std::uint64_t key = is_part_of_ground(leaf) ? format::key(format::kGroundTree, leaf.cell.code) : leaf.key;
  return decoded(rows_, BlobKind::Block, key, [&](const auto& bytes) {
    const BlockLattice block = decode_lattice(leaf.cell, items_of(key, bytes));
    if (block.points != leaf.points) throw DecodeError("does not agree with its directory");
    return block.lattice;
  });
}

std::optional<PostHeights> StoreFile::posts_once(const Leaf& leaf) const {
  if (is_part_of_ground(leaf)) return std::nullopt;
  return decoded(rows_, BlobKind::Block, leaf.key, [&](const auto& bytes) {
    std::optional<PostHeights> posts = decode_posts(leaf.cell, items_of(leaf.key, bytes));
    if (posts && posts->heights.size() != leaf.points) throw DecodeError("does not agree with its directory");
    return posts;
  });
}

void StoreFile::segments(const GridBox& box, std::vector<Segment>& out) const {
  for (auto tree = chunks_.lower_bound(format::kFirstEdgeTree); tree != chunks_.end(); ++tree)
    segments_of(tree->first, box, out);
}

void StoreFile::outline(const GridBox& box, std::vector<Segment>& out) const {
  segments_of(format::edge_tree(kCoverage), box, out);
}

void StoreFile::segments_of(int tree, const GridBox& box, std::vector<Segment>& out) const {
  for_each_leaf(tree, box, [&](const Leaf& leaf) {
    const std::uint64_t key = cache_key(BlobKind::Block, leaf.key);
    auto edges = std::static_pointer_cast<const std::vector<Segment>>(cache_.find(key));
    if (!edges) {
      edges = std::make_shared<const std::vector<Segment>>(read_edges(leaf));
      cache_.insert(key, edges, sizeof(*edges) + edges->size() * sizeof(Segment));
    }
    for (const Segment& s : *edges)
      if (extent_of(s).meets(box)) out.push_back(s);
  });
}

std::vector<StoredFootprint> StoreFile::read_footprints(std::uint16_t theme, std::uint32_t number) const {
  return decoded(rows_, BlobKind::Block, format::footprint_key(theme, number),
                 [](const auto& bytes) { return decode_footprints(bytes); });
}

std::vector<FeatureRecord> StoreFile::read_features(std::uint16_t theme, std::uint32_t number) const {
  return decoded(rows_, BlobKind::Block, format::feature_key(theme, number), [&](const auto& bytes) {
    const ThemeInfo& info = metadata_.themes[theme - std::size_t{1}];
    std::vector<FeatureRecord> records = decode_features(bytes, info.fields.size());
    if (number + 1 < info.feature_blocks && records.size() < kFeaturesInBlock)
      throw DecodeError("has the wrong number of features");
    return records;
  });
}

std::int32_t StoreFile::greatest_height(std::uint16_t part, const GridBox& box) const {
  std::int32_t greatest = 0;
  for_each_leaf(format::vertex_tree(part), box, [&](const Leaf& leaf) { greatest = std::max(greatest, leaf.hi); });
  return greatest;
}

std::vector<Certificate::Cell> StoreFile::cuts(std::uint16_t part, const GridBox& box) const {
  std::vector<Certificate::Cell> cells;
  for_each_leaf(format::vertex_tree(part), box, [&](const Leaf& leaf) {
    if (leaf.lo < 0) cells.push_back({leaf.cell.code, leaf.cell.end(), {leaf.lo, 0}});
  });
  return cells;
}

namespace {

/// Tells whether the box contains all that a chunk may hold within `bounds`.
bool holds(const GridBox& box, const ChunkEntry& chunk, const GridBox& bounds) {
  for (Cell cell{chunk.code, 0}; cell.code < chunk.end; cell = {cell.end(), 0}) {
    while (cell.parent().code == cell.code && cell.parent().end() <= chunk.end) cell = cell.parent();
    if (!box.contains(intersection(cell.box(), bounds))) return false;
  }
  return true;
}

/// Returns the number of grid positions in a box.
double positions_of(const GridBox& box) {
  if (box.empty()) return 0;
  return (double{1} * box.xmax - box.xmin + 1) * (double{1} * box.ymax - box.ymin + 1);
}

void require_level(int level, int count) {
  if (level < 0 || level >= count) throw InputError("level " + std::to_string(level) + ": the store has none");
}

}  // namespace

std::uint64_t StoreFile::points_about(int level, const Box& box) const {
  require_level(level, level_count());
  const GridBox units = metadata_.grid.enclosing(box);
  double points = 0;
  // The tree of the ground has all levels; the others have one each.
  for (int k = level; k < (level == 0 ? 1 : level_count()); ++k) {
    const auto add_leaf = [&](const Leaf& leaf) {
      const GridBox there = intersection(leaf.cell.box(), metadata_.bounds);
      if (leaf.points > 0) points += leaf.points * positions_of(intersection(there, units)) / positions_of(there);
    };
    const auto add_whole = [&](const ChunkEntry& chunk) {
      const bool whole = holds(units, chunk, metadata_.bounds);
      if (whole) points += static_cast<double>(chunk.points);
      return whole;
    };
    for_each_leaf(k, units, add_leaf, add_whole);
  }
  return static_cast<std::uint64_t>(points);
}

Certificate StoreFile::certificate(int level, const Box& box) const {
  require_level(level, level_count());
  std::vector<Certificate::Cell> cells;
  for_each_leaf(level, metadata_.grid.enclosing(box), [&](const Leaf& leaf) {
    cells.push_back({leaf.cell.code, leaf.cell.end(), {leaf.lo, leaf.hi}});
  });
  return Certificate(std::move(cells));
}

std::optional<CertifiedError> StoreFile::certified_error(int level, const Box& box) const {
  require_level(level, level_count());
  std::optional<CertifiedError> widest;
  const double unit = metadata_.grid.resolution;
  for_each_leaf(level, metadata_.grid.enclosing(box), [&](const Leaf& leaf) {
    if (!widest) widest = CertifiedError{leaf.lo * unit, leaf.hi * unit};
    widest->lo = std::min(widest->lo, leaf.lo * unit);
    widest->hi = std::max(widest->hi, leaf.hi * unit);
  });
  return widest;
}

}  // namespace itin
