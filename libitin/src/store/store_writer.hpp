// Writes a whole store, leaf by leaf, into a temporary file beside the target; commit() puts it in place at once.
//
//   StoreWriter writer(path, crs_wkt, grid, tolerances);
//   for each leaf of the ground in Morton order: writer.add_ground(...);
//   for each level from 1 on: for each leaf in Morton order: writer.add_leaf(...);
//   for each theme with vertices of its own, ascending: writer.add_theme_vertices(...);
//   for each part of a raised theme, ascending: writer.add_part_vertices(...);
//   writer.add_segments(segments);
//   for each cell and then each theme of what is not in the surface as it came: writer.set_aside(...);
//   for each theme: writer.add_footprints(theme, footprints);
//   for each theme: writer.add_features(theme, records);
//   writer.commit(sources, themes);
//
// Until commit() returns, and whatever happens before, the file at `path` is unchanged. Destroying an uncommitted
// writer removes the temporary file. The next writer removes a file that a killed process left behind.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include <itin/progress.hpp>
#include <itin/store.hpp>

#include "store/codec/encoded_leaf.hpp"
#include "store/codec/point_index.hpp"
#include "store/codec/store_format.hpp"
#include "store/feature_table.hpp"
#include "store/file/database.hpp"
#include "store/file/directory.hpp"
#include "store/file/replacement_file.hpp"
#include "store/segments/clusters.hpp"
#include "store/segments/footprint_codec.hpp"
#include "store/segments/segment_features.hpp"
#include "store/set_aside.hpp"

namespace itin {

/// How far a feature reaches above the full surface under it, and how far it cuts below, grid units; neither is
/// negative.
struct FeatureReach {
  GridBox box;
  std::int32_t height = 0, depth = 0;
};

class StoreWriter {
 public:
  /// Takes tolerances in metres, level 0 (tolerance 0) first. Throws FileError.
  StoreWriter(const std::string& path, const std::string& crs_wkt, const Grid& grid,
              const std::vector<double>& tolerances);
  /// Writes a store that takes the place of that file.
  StoreWriter(std::unique_ptr<ReplacementFile> file, const std::string& crs_wkt, const Grid& grid,
              const std::vector<double>& tolerances);
  StoreWriter(const StoreWriter&) = delete;
  StoreWriter& operator=(const StoreWriter&) = delete;

  /// Sets the first level whose vertices are stored a second time, to be read by themselves: 1 unless it is set. Goes
  /// before all leaves.
  void set_fine_levels(int levels);
  /// Sets StoreMetadata::right_triangle_levels.
  void set_right_triangle_levels(int levels);
  /// Adds a leaf of the ground: all vertices of the full surface in a cell, in Morton order, possibly none, each with
  /// its coarsest level. Leaves come in ascending order of cell.code, before those of levels.
  void add_ground(const Cell& cell, std::span<const GridPoint> points, std::span<const std::uint16_t> sources,
                  std::span<const std::uint8_t> levels);
  /// Adds one leaf of the tree of a level from 1 on, with the vertices whose coarsest level this is. Leaves come in
  /// ascending order of (level, cell.code), `points` in Morton order, possibly none (an empty cell over ground still
  /// has its certificate); lo and hi are in grid units. Points of fine levels are counted only.
  void add_leaf(int level, const Cell& cell, std::span<const GridPoint> points, std::span<const std::uint16_t> sources,
                std::int32_t lo, std::int32_t hi);
  /// Takes over the ground of a store of the same grid and levels: all leaves of its ground and of its levels, byte for
  /// byte. It stands for add_ground() and add_leaf(). `outline` is that of the ground. Throws CorruptStore.
  void take_ground(const Store& store, std::span<const Segment> outline, Progress& progress);
  /// These add a leaf that is encoded already.
  void add_ground(const EncodedLeaf& leaf);
  void add_leaf(const EncodedLeaf& leaf);
  /// Adds the vertices that are not part of the full surface, but of this theme's lines on it; in Morton order.
  void add_theme_vertices(std::uint16_t theme, std::span<const GridPoint> points,
                          std::span<const std::uint16_t> sources);
  /// Adds the vertices of a part of a raised theme; parts are numbered after the themes. Points with format::kMask as
  /// their source are no vertices. Each cell takes the greatest of the reaches that it meets; cells without points are
  /// written, too, where it is above 0. `clusters` has every point, or is empty.
  void add_part_vertices(std::uint16_t part, std::span<const GridPoint> points, std::span<const std::uint16_t> sources,
                         std::span<const FeatureReach> reaches, const PartClusters& clusters = {});
  /// Adds the coverage outline and the lines of all themes, all at once, in any order; each theme has an edge quadtree
  /// of its own. `features` are the features of segments, ascending. `clusters` are those of parts, by number; each has
  /// every segment of the part, or is empty.
  void add_segments(const std::vector<Segment>& segments, std::span<const SegmentFeature> features = {},
                    const std::map<std::uint16_t, PartClusters>& clusters = {});
  /// Sets aside points of the ground that the surface does not have unchanged; cell by cell, in Morton order.
  void set_aside(const Cell& cell, std::span<const GridPoint> points, std::span<const std::uint16_t> sources);
  /// Sets aside lines of a theme that the surface does not have unchanged.
  void set_aside(std::uint16_t theme, const SetAsideLines& lines);
  /// Takes over the points of the ground that a store has set aside; stands for set_aside() of points.
  void take_points_set_aside(const Store& store);
  void count_set_aside(const SetAsideCounts& counts) { set_aside_.counts = counts; }
  /// Adds a theme's footprints. Returns the number of their blocks.
  std::uint32_t add_footprints(std::uint16_t theme, std::span<const StoredFootprint> footprints);
  /// Adds the records of a theme's features. Returns the number of their blocks.
  std::uint32_t add_features(std::uint16_t theme, std::span<const FeatureRecord> records);
  /// Completes the store: syncs and renames. The certified error of each level is the union of its leaves'. Throws
  /// FileError (disk full, ...).
  void commit(std::vector<SourceInfo> sources, std::vector<ThemeInfo> themes = {}, std::vector<ThemePart> parts = {});

 private:
  void add_points(const EncodedLeaf& encoded);
  void add_edges(std::uint16_t theme, std::vector<Segment> segments, std::span<const SegmentFeature> features,
                 const PartClusters& clusters);
  void append(const Leaf& leaf, std::span<const std::uint8_t> block);
  void flush_chunk();
  void insert(Statement& statement, BlobKind kind, std::uint64_t key, std::span<const std::uint8_t> bytes);
  void widen(LevelInfo& level, std::int32_t lo, std::int32_t hi) const;

  // Members are destroyed in reverse order: statements, database, file.
  std::unique_ptr<ReplacementFile> file_;
  Database database_;
  std::optional<Statement> insert_block_, insert_chunk_;
  StoreMetadata metadata_;
  DirectoryChunk chunk_;
  ChunkList chunks_;
  SetAsideList set_aside_;
  std::set<std::uint16_t> with_features_;  ///< themes whose segments know their features
  std::set<std::uint16_t> with_clusters_;  ///< parts
  Leaf last_;                              ///< the last leaf added; only its tree and cell matter
  bool has_last_ = false;
};

/// The most points in a leaf of a store's quadtree.
inline constexpr std::uint32_t kLeafCapacity = 512;
/// The most points in a leaf of the ground. Posts of a raster are read many at once, and larger blocks take fewer
/// bytes.
inline constexpr std::uint32_t kGroundCapacity = 2048;

}  // namespace itin
