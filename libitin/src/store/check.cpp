// Reads all of a store and names what is damaged, never stopping at the first.

#include <algorithm>
#include <array>
#include <vector>

#include <xxhash.h>

#include <itin/box_of.hpp>
#include <itin/error.hpp>
#include <itin/store.hpp>

#include "store/cluster_check.hpp"
#include "store/codec/store_format.hpp"
#include "store/set_aside.hpp"
#include "store/store_file.hpp"

namespace itin {

namespace {

constexpr const char* kForeignSource = "names a source that the store does not have";
constexpr const char* kForeignFeature = "names a feature that the store does not have";

class Inspection {
 public:
  Inspection(const StoreFile& file, Progress& progress) : file_(file), progress_(progress) {}

  std::vector<Damage> run() {
    for (const std::string& what : file_.rows().structural_damage()) damage_.push_back({"file", what});
    for (const auto& [tree, chunks] : file_.chunks()) {
      for (const ChunkEntry& entry : chunks) total_ += entry.leaves;
    }
    inspect_features();
    for (const auto& [tree, chunks] : file_.chunks()) inspect_tree(tree, chunks);
    inspect_footprints();
    guarded([&] { inspect_set_aside(); });
    compare_keys(BlobKind::Directory, chunk_keys_);
    compare_keys(BlobKind::Block, block_keys_);
    compare_totals();
    if (damage_.empty()) damage_ = false_clusters(file_, progress_);
    progress_.report("checking", 1);
    return std::move(damage_);
  }

 private:
  // Runs `read` and keeps the damage that it finds. Only a damaged place is a finding: an unreadable disk ends the
  // check.
  template <typename Read>
  void guarded(const Read& read) {
    try {
      read();
    } catch (const CorruptStore& e) {
      const std::string prefix = e.path() + ": " + e.place() + ": ";
      const std::string what = e.what();
      damage_.push_back({e.place(), what.starts_with(prefix) ? what.substr(prefix.size()) : what});
    }
  }

  void inspect_tree(int tree, const std::vector<ChunkEntry>& chunks) {
    const bool known = tree < file_.level_count() ||
                       (tree >= format::kMaxLevels &&
                        format::theme_of(tree) <= file_.metadata().themes.size() + file_.metadata().parts.size());
    if (!known) damage_.push_back({format::place("directory", format::kChunkListKey), "lists an unknown tree"});
    for (const ChunkEntry& entry : chunks) {
      progress_.throw_if_cancelled();
      progress_.report("checking",
                       static_cast<double>(done_) / static_cast<double>(std::max<std::uint64_t>(total_, 1)));
      chunk_keys_.push_back(format::key(tree, entry.code));
      guarded([&] { inspect_leaves(tree, file_.read_chunk(tree, entry)); });
      done_ += entry.leaves;
    }
  }

  /// Tells whether the leaf's certificate is possible: at a level's own points both surfaces meet.
  static bool holds_certificate(const Leaf& leaf) {
    return leaf.lo <= leaf.hi && (leaf.points == 0 || (leaf.lo <= 0 && leaf.hi >= 0));
  }

  void inspect_leaves(int tree, const DirectoryChunk& chunk) {
    for (const Leaf& leaf : chunk) {
      const bool counts_only = tree != format::kGroundTree && tree < file_.metadata().fine_levels;
      if (leaf.points > 0 && !counts_only) block_keys_.push_back(leaf.key);
      if (format::is_edge_tree(tree)) {
        guarded([&] { inspect_edges(leaf); });
        continue;
      }
      if (!holds_certificate(leaf)) damage_.push_back({format::place("directory", leaf.key), "has no certificate"});
      if (counts_only) own_trees_[static_cast<std::size_t>(tree)].vertices += leaf.points;
      if (leaf.points > 0 && !counts_only) guarded([&] { inspect_block(leaf); });
    }
  }

  void inspect_block(const Leaf& leaf) {
    const Block block = file_.read_block(leaf);
    bounds_.extend(box_of(block.points));
    const bool of_part = format::theme_of(leaf.level) > file_.metadata().themes.size();
    const std::size_t sources = file_.metadata().sources.size();
    std::uint64_t vertices = 0;
    bool foreign = false;
    for (std::size_t k = 0; k < block.points.size(); ++k) {
      const std::uint16_t source = block.sources[k];
      const bool mask = of_part && source == format::kMask;
      vertices += mask ? 0 : 1;
      foreign |= !mask && (of_part ? source & ~format::kOnOutline : source) >= sources;
    }
    if (leaf.level < format::kMaxLevels)
      count_levels(leaf, block);
    else
      vertices_[static_cast<std::size_t>(leaf.level)] += vertices;
    if (file_.has_clusters(format::theme_of(leaf.level))) file_.read_clusters(leaf, extents_of(block.points));
    if (foreign) damage_.push_back({format::place("block", leaf.key), kForeignSource});
  }

  /// Vertices by number, with a sum that tells apart sets of them, in whatever order they come.
  struct Counted {
    std::uint64_t vertices = 0, sum = 0;
    void add(const GridPoint& p, std::uint16_t source) {
      const std::array<std::uint64_t, 2> words{code_of(p),
                                               std::uint64_t{static_cast<std::uint32_t>(p.z)} << 16 | source};
      ++vertices, sum += XXH3_64bits(words.data(), sizeof words);
    }
    friend bool operator==(const Counted&, const Counted&) = default;
  };

  /// Counts vertices by level, those of the ground and those of a level's own tree.
  void count_levels(const Leaf& leaf, const Block& block) {
    std::vector<Counted>& counted = leaf.level == format::kGroundTree ? levels_ : own_trees_;
    for (std::size_t k = 0; k < block.points.size(); ++k) {
      const std::size_t level = level_of(leaf, block, k);
      if (level >= levels_.size())
        throw CorruptStore(file_.rows().path(), format::place("block", leaf.key), "has an unknown level");
      counted[level].add(block.points[k], block.sources[k]);
    }
  }

  void inspect_edges(const Leaf& leaf) {
    const std::vector<Segment> edges = file_.read_edges(leaf);
    if (file_.has_clusters(format::theme_of(leaf.level))) file_.read_clusters(leaf, extents_of(edges));
    for (const Segment& s : edges) {
      // A segment is listed in every leaf that it meets. It counts in the leaf where it starts, as part of the full
      // surface.
      if (s.finest == 0 && leaf.cell.contains(code_of(s.a()))) segments_[s.theme] += 1;
    }
    inspect_segment_features(leaf);
  }

  void inspect_segment_features(const Leaf& leaf) {
    const std::size_t theme = format::theme_of(leaf.level);
    if (theme == 0 || theme > file_.metadata().themes.size()) return;
    if (!file_.metadata().themes[theme - 1].segments_have_features) return;
    const std::vector<SegmentFeature> features = file_.read_segment_features(leaf);
    if (std::any_of(features.begin(), features.end(), [&](const auto& f) { return f.feature >= features_[theme]; }))
      damage_.push_back({format::place("block", leaf.key), kForeignFeature});
  }

  void inspect_features() {
    const std::vector<ThemeInfo>& themes = file_.metadata().themes;
    for (std::size_t t = 1; t <= themes.size(); ++t) {
      for (std::uint32_t i = 0; i < themes[t - 1].feature_blocks; ++i) {
        block_keys_.push_back(format::feature_key(t, i));
        std::size_t records = kFeaturesInBlock;  // assumed for a damaged block: segments that refer to its records are
                                                 // not damaged
        guarded([&] { records = file_.read_features(static_cast<std::uint16_t>(t), i).size(); });
        features_[t] += records;
      }
    }
  }

  void inspect_footprints() {
    const std::vector<ThemeInfo>& themes = file_.metadata().themes;
    for (std::size_t t = 1; t <= themes.size(); ++t) {
      for (std::uint32_t i = 0; i < themes[t - 1].footprint_blocks; ++i) {
        block_keys_.push_back(format::footprint_key(t, i));
        guarded([&] {
          for (const StoredFootprint& f : file_.read_footprints(static_cast<std::uint16_t>(t), i)) {
            if (f.source < file_.metadata().sources.size()) continue;
            damage_.push_back({format::place("block", format::footprint_key(t, i)), kForeignSource});
          }
        });
      }
    }
  }

  void inspect_set_aside() {
    const StoreRows& rows = file_.rows();
    chunk_keys_.push_back(format::kSetAsideListKey);
    const SetAsideList list = set_aside_list(rows);
    const auto is_foreign = [&](std::uint16_t source) { return source >= file_.metadata().sources.size(); };
    const auto inspect = [&](std::uint64_t theme, std::uint32_t block, const auto& what_is_wrong) {
      const std::uint64_t key = format::set_aside_key(theme, block);
      block_keys_.push_back(key);
      guarded([&] {
        if (const char* what = what_is_wrong()) damage_.push_back({format::place("block", key), what});
      });
    };
    for (std::uint32_t i = 0; i < list.point_blocks; ++i) {
      inspect(0, i, [&]() -> const char* {
        const PointSources sources = set_aside_points(rows, i).sources;
        for (std::size_t k = 0; k < sources.size(); ++k)
          if (is_foreign(sources[k])) return kForeignSource;
        return nullptr;
      });
    }
    for (std::size_t t = 1; t <= list.line_blocks.size(); ++t) {
      const auto theme = static_cast<std::uint16_t>(t);
      for (std::uint32_t i = 0; i < list.blocks_of(theme); ++i) {
        inspect(theme, i, [&]() -> const char* {
          for (const ImportedSegment& s : set_aside_lines(rows, theme, i).imported) {
            if (is_foreign(s.source)) return kForeignSource;
            if (s.feature != kNoFeature && s.feature >= features_[theme]) return kForeignFeature;
          }
          return nullptr;
        });
      }
    }
  }

  // Finds rows that no directory leads to. Missing rows were found when they were to be read.
  void compare_keys(BlobKind kind, std::vector<std::uint64_t>& expected) {
    if (kind == BlobKind::Directory) expected.push_back(format::kChunkListKey);
    if (!damage_.empty()) return;  // a damaged chunk would make all its blocks look lost
    std::sort(expected.begin(), expected.end());
    guarded([&] {
      file_.rows().for_each_key(kind, [&](std::uint64_t key) {
        if (std::binary_search(expected.begin(), expected.end(), key)) return;
        damage_.push_back({format::place(table_name(kind), key), "belongs to no leaf"});
      });
    });
  }

  void compare_totals() {
    if (!damage_.empty()) return;
    const StoreMetadata& metadata = file_.metadata();
    std::uint64_t sum = 0;
    for (std::size_t level = 0; level < metadata.levels.size(); ++level) {
      sum += levels_[level].vertices;
      if (levels_[level].vertices != metadata.levels[level].vertices)
        damage_.push_back({"metadata", "level " + std::to_string(level) + " has another number of vertices"});
      const bool fine = static_cast<int>(level) < metadata.fine_levels;
      if (level > 0 &&
          (fine ? own_trees_[level].vertices != levels_[level].vertices : own_trees_[level] != levels_[level]))
        damage_.push_back({"metadata", "level " + std::to_string(level) + " has other vertices in its own tree"});
    }
    for (std::size_t theme = 1; theme <= metadata.themes.size(); ++theme) {
      sum += vertices_[static_cast<std::size_t>(format::vertex_tree(static_cast<int>(theme)))];
      if (metadata.themes[theme - 1].is_raised())
        segments_[theme] = 0;  // they keep the ground about features, and belong to none
      for (std::size_t p = 0; p < metadata.parts.size(); ++p) {
        if (metadata.parts[p].theme != theme) continue;
        const std::size_t number = metadata.themes.size() + p + 1;
        sum += vertices_[static_cast<std::size_t>(format::vertex_tree(static_cast<int>(number)))];
        segments_[theme] += segments_[number];
      }
      if (segments_[theme] == metadata.themes[theme - 1].segments) continue;
      damage_.push_back({"metadata", "theme '" + metadata.themes[theme - 1].name + "' has another number of segments"});
    }
    if (sum != metadata.vertices) damage_.push_back({"metadata", "the number of vertices is another"});
    if (bounds_ != metadata.bounds) damage_.push_back({"metadata", "the bounds are not those of the vertices"});
  }

  const StoreFile& file_;
  Progress& progress_;
  std::vector<Damage> damage_;
  std::uint64_t total_ = 0, done_ = 0;
  std::vector<std::uint64_t> chunk_keys_, block_keys_;
  std::vector<std::uint64_t> vertices_ = std::vector<std::uint64_t>(format::kFirstEdgeTree);  ///< by tree
  std::vector<Counted> levels_ = std::vector<Counted>(file_.metadata().levels.size());     ///< as the ground has them
  std::vector<Counted> own_trees_ = std::vector<Counted>(file_.metadata().levels.size());  ///< as their trees have them
  std::vector<std::uint64_t> segments_ = std::vector<std::uint64_t>(format::kLastTree);    ///< by theme
  std::vector<std::uint64_t> features_ =
      std::vector<std::uint64_t>(format::kMaxThemes + 1);  ///< number of features with records, by theme
  GridBox bounds_;
};

}  // namespace

std::vector<Damage> check(const Store& store, Progress& progress) {
  return Inspection(*store.file_, progress).run();
}

}  // namespace itin
