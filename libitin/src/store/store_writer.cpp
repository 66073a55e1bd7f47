#include "store/store_writer.hpp"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <utility>

#include <itin/grid_scale.hpp>

#include "base/stoppable.hpp"
#include "geometry/morton_range.hpp"
#include "store/codec/block_codec.hpp"
#include "store/codec/seal.hpp"
#include "store/file/leaf_cutter.hpp"
#include "store/metadata_json.hpp"
#include "store/segments/block_preface.hpp"
#include "store/segments/edge_quadtree.hpp"
#include "store/segments/lateral_tolerance.hpp"
#include "store/segments/line_codec.hpp"
#include "store/store_file.hpp"

namespace itin {

static_assert(kGroundCapacity <= kMaxBlockPoints);

namespace {

/// Widens the bounds of the leaves that the reach's box meets; the leaves tile the root along the curve.
void raise(std::vector<Leaf>& leaves, const FeatureReach& reach) {
  const MortonRange range(reach.box);
  for (std::optional<std::uint64_t> code = range.next(0); code;) {
    const auto leaf = std::upper_bound(leaves.begin(), leaves.end(), *code,
                                       [](std::uint64_t c, const Leaf& l) { return c < l.cell.end(); });
    if (leaf == leaves.end()) return;
    leaf->hi = std::max(leaf->hi, reach.height);
    leaf->lo = std::min(leaf->lo, -reach.depth);
    code = range.next(leaf->cell.end());
  }
}

}  // namespace

StoreWriter::StoreWriter(const std::string& path, const std::string& crs_wkt, const Grid& grid,
                         const std::vector<double>& tolerances)
    : StoreWriter(std::make_unique<ReplacementFile>(path), crs_wkt, grid, tolerances) {}

StoreWriter::StoreWriter(std::unique_ptr<ReplacementFile> file, const std::string& crs_wkt, const Grid& grid,
                         const std::vector<double>& tolerances)
    : file_(std::move(file)), database_(Database::create(file_->temporary_path(), file_->target())) {
  if (tolerances.empty() || tolerances.size() > format::kMaxLevels) {
    throw std::invalid_argument("a store has 1 to 64 levels");
  }
  metadata_.crs_wkt = crs_wkt;
  metadata_.grid = grid;
  for (const double t : tolerances) metadata_.levels.push_back({t, lateral_tolerance(t), 0, {}});
  database_.execute("PRAGMA page_size=" + std::to_string(format::kPageSize) + ";PRAGMA encoding='UTF-8';");
  database_.execute("PRAGMA application_id=" + std::to_string(format::kApplicationId) +
                    ";PRAGMA user_version=" + std::to_string(format::kVersion) + ";");
  database_.execute(std::string("BEGIN;") + format::kSchema);
  insert_block_ = database_.prepare("INSERT INTO block(key, data) VALUES(?, ?)");
  insert_chunk_ = database_.prepare("INSERT INTO directory(key, data) VALUES(?, ?)");
}

void StoreWriter::insert(Statement& statement, BlobKind kind, std::uint64_t key, std::span<const std::uint8_t> bytes) {
  statement.bind(1, static_cast<std::int64_t>(key));
  statement.bind(2, seal(kind, key, bytes));
  statement.step("row");
  statement.reset();
}

void StoreWriter::append(const Leaf& leaf, std::span<const std::uint8_t> block) {
  const bool same_tree = has_last_ && last_.level == leaf.level;
  if (leaf.cell.log2_side < format::kMinLeafLog2Side || (has_last_ && last_.level > leaf.level) ||
      (same_tree && last_.cell.end() > leaf.cell.code)) {
    throw std::invalid_argument("leaves must come in order, disjoint, with sides of at least 16");
  }
  if (!chunk_.empty() && (!same_tree || chunk_.size() == format::kChunkLeaves)) flush_chunk();
  chunk_.push_back(leaf);
  last_ = leaf, has_last_ = true;
  if (!block.empty()) insert(*insert_block_, BlobKind::Block, leaf.key, block);
}

void StoreWriter::flush_chunk() {
  const int tree = chunk_.front().level;
  insert(*insert_chunk_, BlobKind::Directory, chunk_.front().key, encode_chunk(chunk_));
  chunks_[tree].push_back(entry_of(chunk_));
  chunk_.clear();
}

void StoreWriter::widen(LevelInfo& level, std::int32_t lo, std::int32_t hi) const {
  level.certified_error.lo = std::min(level.certified_error.lo, lo * metadata_.grid.resolution);
  level.certified_error.hi = std::max(level.certified_error.hi, hi * metadata_.grid.resolution);
}

void StoreWriter::set_fine_levels(int levels) {
  if (has_last_ || levels < 1 || static_cast<std::size_t>(levels) > metadata_.levels.size())
    throw std::invalid_argument("not a number of fine levels");
  metadata_.fine_levels = levels;
}

void StoreWriter::set_right_triangle_levels(int levels) {
  if (levels < 0 || static_cast<std::size_t>(levels) >= metadata_.levels.size())
    throw std::invalid_argument("not a number of levels with right triangles");
  metadata_.right_triangle_levels = levels;
}

void StoreWriter::add_ground(const Cell& cell, std::span<const GridPoint> points,
                             std::span<const std::uint16_t> sources, std::span<const std::uint8_t> levels) {
  // The encoder takes more points, and does not check that there are as many of each.
  if (points.size() > kGroundCapacity || points.size() != sources.size() || points.size() != levels.size())
    throw std::invalid_argument("not a leaf of this store");
  add_ground(encode_ground(cell, points, sources, levels));
}

void StoreWriter::add_ground(const EncodedLeaf& encoded) {
  for (std::size_t k = 0; k < encoded.vertices_of_level.size(); ++k) {
    if (k >= metadata_.levels.size()) throw std::invalid_argument("not a leaf of this store");
    metadata_.levels[k].vertices += encoded.vertices_of_level[k];
  }
  add_points(encoded);
}

void StoreWriter::take_ground(const Store& store, std::span<const Segment> outline, Progress& progress) {
  const StoreFile& file = file_of(store);
  set_fine_levels(file.metadata().fine_levels);
  metadata_.right_triangle_levels = file.metadata().right_triangle_levels;
  metadata_.levels = file.metadata().levels;
  // The outermost vertices of the ground lie on its outline.
  for (const Segment& s : outline) metadata_.bounds.extend(extent_of(s));
  for (const LevelInfo& level : metadata_.levels) metadata_.vertices += level.vertices;
  std::uint64_t leaves = 0, taken = 0;
  for (const auto& [tree, chunks] : file.chunks())
    for (const ChunkEntry& chunk : chunks) leaves += tree < format::kMaxLevels ? chunk.leaves : 0;
  for (int tree = format::kGroundTree; tree < format::kMaxLevels; ++tree) {
    const bool has_blocks = tree == format::kGroundTree || tree >= metadata_.fine_levels;
    file.for_each_leaf_of(tree, [&](const Leaf& leaf) {
      progress.throw_if_cancelled();
      progress.report("copying the ground", static_cast<double>(++taken) / static_cast<double>(leaves));
      if (!has_blocks || leaf.points == 0) return append(leaf, {});
      file.rows().read(BlobKind::Block, leaf.key, [&](StoreRows::Bytes block) { append(leaf, block); });
    });
  }
}

void StoreWriter::add_leaf(int level, const Cell& cell, std::span<const GridPoint> points,
                           std::span<const std::uint16_t> sources, std::int32_t lo, std::int32_t hi) {
  if (points.size() > kLeafCapacity || points.size() != sources.size())
    throw std::invalid_argument("not a leaf of this store");
  const bool read_by_itself = level >= metadata_.fine_levels;
  add_leaf(read_by_itself ? encode_leaf(level, cell, points, sources, lo, hi) : bare_leaf(level, cell, points, lo, hi));
}

void StoreWriter::add_leaf(const EncodedLeaf& encoded) {
  const Leaf& leaf = encoded.leaf;
  if (leaf.level < 1 || static_cast<std::size_t>(leaf.level) >= metadata_.levels.size() || leaf.points > kLeafCapacity)
    throw std::invalid_argument("not a leaf of this store");
  widen(metadata_.levels[static_cast<std::size_t>(leaf.level)], leaf.lo, leaf.hi);
  append(leaf, encoded.block);
}

void StoreWriter::add_points(const EncodedLeaf& encoded) {
  metadata_.bounds.extend(encoded.bounds);
  metadata_.vertices += encoded.vertices;
  append(encoded.leaf, encoded.block);
}

void StoreWriter::add_theme_vertices(std::uint16_t theme, std::span<const GridPoint> points,
                                     std::span<const std::uint16_t> sources) {
  if (theme == kCoverage || theme > format::kMaxThemes || points.size() != sources.size()) {
    throw std::invalid_argument("not a theme's vertices");
  }
  std::size_t first = 0;
  LeafCutter cutter(kLeafCapacity, [&](const Cell& cell, std::uint32_t count) {
    if (count > 0) {
      add_points(encode_leaf(format::vertex_tree(theme), cell, points.subspan(first, count),
                             sources.subspan(first, count), 0, 0));
    }
    first += count;
  });
  for (const GridPoint& p : points) cutter.add(code_of(p));
  cutter.finish();
}

void StoreWriter::add_segments(const std::vector<Segment>& segments, std::span<const SegmentFeature> features,
                               const std::map<std::uint16_t, PartClusters>& clusters) {
  std::map<std::uint16_t, std::vector<Segment>> by_theme;
  for (const Segment& s : segments) by_theme[s.theme].push_back(s);
  for (const SegmentFeature& f : features) with_features_.insert(f.segment.theme);
  for (auto& [theme, of_theme] : by_theme) {
    const auto of_part = clusters.find(theme);
    add_edges(theme, std::move(of_theme), features, of_part == clusters.end() ? PartClusters() : of_part->second);
  }
}

void StoreWriter::add_part_vertices(std::uint16_t part, std::span<const GridPoint> points,
                                    std::span<const std::uint16_t> sources, std::span<const FeatureReach> reaches,
                                    const PartClusters& clusters) {
  if (!clusters.empty()) with_clusters_.insert(part);
  if (part == kCoverage || part > format::kMaxThemes || points.size() != sources.size()) {
    throw std::invalid_argument("not a part of a theme");
  }
  std::vector<Leaf> leaves;
  LeafCutter cutter(kLeafCapacity, [&](const Cell& cell, std::uint32_t count) {
    Leaf& leaf = leaves.emplace_back();
    leaf.cell = cell, leaf.points = count;
  });
  for (const GridPoint& p : points) cutter.add(code_of(p));
  cutter.finish();
  for (const FeatureReach& reach : reaches) raise(leaves, reach);
  std::size_t first = 0;
  for (const Leaf& leaf : leaves) {
    if (leaf.points > 0 || leaf.hi > 0 || leaf.lo < 0) {
      const auto own = points.subspan(first, leaf.points);
      EncodedLeaf encoded =
          encode_leaf(format::vertex_tree(part), leaf.cell, own, sources.subspan(first, leaf.points), leaf.lo, leaf.hi);
      if (!clusters.empty() && leaf.points > 0)
        encoded.block = joined({encode_clusters(leaf.cell, extents_of(own), clusters.of(own)), encoded.block});
      add_points(encoded);
    }
    first += leaf.points;
  }
}

std::uint32_t StoreWriter::add_footprints(std::uint16_t theme, std::span<const StoredFootprint> footprints) {
  std::uint32_t blocks = 0;
  for (; !footprints.empty(); ++blocks) {
    const auto some = footprints.first(std::min(footprints.size(), kFootprintsInBlock));
    metadata_.has_foundations |=
        std::any_of(some.begin(), some.end(), [](const StoredFootprint& f) { return f.feature.flat_foundation; });
    insert(*insert_block_, BlobKind::Block, format::footprint_key(theme, blocks), encode_footprints(some));
    footprints = footprints.subspan(some.size());
  }
  return blocks;
}

std::uint32_t StoreWriter::add_features(std::uint16_t theme, std::span<const FeatureRecord> records) {
  std::uint32_t blocks = 0;
  for (; !records.empty(); ++blocks) {
    const auto some = records.first(std::min(records.size(), kFeaturesInBlock));
    insert(*insert_block_, BlobKind::Block, format::feature_key(theme, blocks), encode_features(some));
    records = records.subspan(some.size());
  }
  return blocks;
}

void StoreWriter::set_aside(const Cell& cell, std::span<const GridPoint> points,
                            std::span<const std::uint16_t> sources) {
  insert(*insert_block_, BlobKind::Block, format::set_aside_key(0, set_aside_.point_blocks++),
         encode_set_aside(cell, points, sources));
}

void StoreWriter::take_points_set_aside(const Store& store) {
  const StoreRows& rows = file_of(store).rows();
  for (const std::uint32_t blocks = set_aside_list(rows).point_blocks; set_aside_.point_blocks < blocks;) {
    const std::uint64_t key = format::set_aside_key(0, set_aside_.point_blocks++);
    rows.read(BlobKind::Block, key,
              [&](StoreRows::Bytes block) { insert(*insert_block_, BlobKind::Block, key, block); });
  }
}

void StoreWriter::set_aside(std::uint16_t theme, const SetAsideLines& lines) {
  if (theme == kCoverage || theme > format::kMaxThemes) throw std::invalid_argument("not a theme");
  if (set_aside_.line_blocks.size() < theme) set_aside_.line_blocks.resize(theme);
  std::uint32_t& blocks = set_aside_.line_blocks[theme - std::size_t{1}];
  const auto some = [&](auto& rest) {
    const auto first = rest.first(std::min(rest.size(), kSetAsideInBlock));
    rest = rest.subspan(first.size());
    return first;
  };
  std::span<const ImportedSegment> imported = lines.imported;
  std::span<const Segment> made = lines.made;
  while (!imported.empty() || !made.empty())
    insert(*insert_block_, BlobKind::Block, format::set_aside_key(theme, blocks++),
           encode_set_aside(some(imported), some(made)));
}

void StoreWriter::add_edges(std::uint16_t theme, std::vector<Segment> segments,
                            std::span<const SegmentFeature> features, const PartClusters& clusters) {
  if (theme > format::kMaxThemes) throw std::invalid_argument("too many themes");
  const auto bytes_of = [&](const Cell& cell, const std::vector<Segment>& in_cell) {
    if (theme == kCoverage) return encode_outline(cell, in_cell);
    std::vector<std::uint8_t> lines = encode_lines(cell, in_cell);
    if (with_features_.contains(theme)) return joined({encode_segment_features(in_cell, features), lines});
    if (clusters.empty()) return lines;
    return joined({encode_clusters(cell, extents_of(in_cell), clusters.of(in_cell)), lines});
  };
  for_each_edge_leaf(std::move(segments), [&](const Cell& cell, const std::vector<Segment>& in_cell) {
    stop_if_asked();
    const int tree = format::edge_tree(theme);
    append({cell, tree, static_cast<std::uint32_t>(in_cell.size()), 0, 0, 0, 0, format::key(tree, cell.code)},
           bytes_of(cell, in_cell));
  });
}

void StoreWriter::commit(std::vector<SourceInfo> sources, std::vector<ThemeInfo> themes, std::vector<ThemePart> parts) {
  if (!chunk_.empty()) flush_chunk();
  insert(*insert_chunk_, BlobKind::Directory, format::kSetAsideListKey, encode_set_aside(set_aside_));
  insert(*insert_chunk_, BlobKind::Directory, format::kChunkListKey, encode_chunk_list(chunks_));
  metadata_.sources = std::move(sources);
  metadata_.themes = std::move(themes);
  for (const std::uint16_t theme : with_features_)
    metadata_.themes.at(theme - std::size_t{1}).segments_have_features = true;
  metadata_.parts = std::move(parts);
  for (const std::uint16_t part : with_clusters_)
    metadata_.parts.at(part - metadata_.themes.size() - 1).has_clusters = true;
  if (metadata_.vertices > 0)
    metadata_.scale = grid_scale_if_known(metadata_.crs_wkt, metadata_.grid.box(metadata_.bounds));
  const std::string text = metadata_to_json(metadata_);
  {
    Statement statement = database_.prepare("INSERT INTO metadata(name, value, checksum) VALUES('store', ?, ?)");
    statement.bind(1, text);
    statement.bind(2, text_checksum(text));
    statement.step("metadata");
  }
  insert_block_.reset();
  insert_chunk_.reset();
  database_.execute("COMMIT");
  database_.close();
  file_->commit();
}

}  // namespace itin
