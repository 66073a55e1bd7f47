// Every name, number and key of the file format in one place. libitin/FORMAT.md explains them.
#pragma once

#include <cstdint>
#include <string>

#include <fmt/format.h>

#include "geometry/cell.hpp"

namespace itin::format {

inline constexpr std::uint32_t kApplicationId = 0x4954494e;  // "ITIN"
/// The only version that is written and read. No release wrote an earlier one.
inline constexpr std::uint32_t kVersion = 11;
inline constexpr int kPageSize = 16384;

inline constexpr const char* kSchema =
    "CREATE TABLE metadata(name TEXT PRIMARY KEY, value TEXT NOT NULL, checksum INTEGER NOT NULL) WITHOUT ROWID;"
    "CREATE TABLE directory(key INTEGER PRIMARY KEY, data BLOB NOT NULL);"
    "CREATE TABLE block(key INTEGER PRIMARY KEY, data BLOB NOT NULL);";

/// Quadtrees are numbered: the ground with all of its vertices is 0, a coarser level's points have the level's number,
/// a theme's own vertices are numbered from kMaxLevels, its edges from kFirstEdgeTree. Theme 0 is the coverage outline,
/// which has no vertices of its own.
inline constexpr int kGroundTree = 0;
inline constexpr int kMaxLevels = 64;
inline constexpr int kFirstEdgeTree = 1024;
inline constexpr int kLastTree = 2046;
inline constexpr int kMaxThemes = 900;  ///< and parts of themes, which are numbered after them
/// The footprints of raised themes as they were imported; blocks without a directory.
inline constexpr int kFootprintTree = 2046;
/// Imported points and lines that are not in the surface (set_aside.hpp); blocks without a directory but for one list.
inline constexpr int kSetAsideTree = 2045;
/// Tables of features (feature_table.hpp); blocks without a directory.
inline constexpr int kFeatureTree = 2044;
/// The flag in the source of a part's vertex that lies between a feature and the ground.
inline constexpr std::uint16_t kOnOutline = 0x8000;
inline constexpr std::size_t kMaxSources = 0x7fff;
/// Stands in place of a point's source: the point is no vertex, but a position where others make way.
inline constexpr std::uint16_t kMask = 0xffff;
/// Stands in place of the finest level of a segment: this is no segment of the part, but one of another theme (its
/// reach) that makes way.
inline constexpr std::uint8_t kMaskedSegment = 0xff;
constexpr int vertex_tree(int theme) {
  return kMaxLevels + theme;
}
constexpr int edge_tree(int theme) {
  return kFirstEdgeTree + theme;
}
constexpr bool is_edge_tree(int tree) {
  return tree >= kFirstEdgeTree;
}
/// Returns the theme of a tree; 0 for the trees of levels.
constexpr std::uint16_t theme_of(int tree) {
  return static_cast<std::uint16_t>(is_edge_tree(tree)   ? tree - kFirstEdgeTree
                                    : tree >= kMaxLevels ? tree - kMaxLevels
                                                         : 0);
}

/// The least side of a leaf: the low 8 bits of its code are therefore zero, and tree and code fit into 63 bits.
inline constexpr int kMinLeafLog2Side = 4;
/// The most leaves in a chunk of a directory.
inline constexpr std::size_t kChunkLeaves = 1024;

/// Returns the key of a leaf's block, or of the directory chunk that begins with the leaf. Keys ascend along the curve.
constexpr std::uint64_t key(int tree, std::uint64_t code) {
  return static_cast<std::uint64_t>(tree) << 52 | code >> 8;
}
constexpr std::uint64_t footprint_key(std::uint64_t theme, std::uint64_t number) {
  return static_cast<std::uint64_t>(kFootprintTree) << 52 | theme << 32 | number;
}
constexpr std::uint64_t feature_key(std::uint64_t theme, std::uint64_t number) {
  return static_cast<std::uint64_t>(kFeatureTree) << 52 | theme << 32 | number;
}
/// Returns the key of a block that is set aside; theme 0 stands for points.
constexpr std::uint64_t set_aside_key(std::uint64_t theme, std::uint64_t number) {
  return static_cast<std::uint64_t>(kSetAsideTree) << 52 | theme << 32 | number;
}
/// The key of the list of set-aside blocks; it is in the directory.
inline constexpr std::uint64_t kSetAsideListKey = std::uint64_t{kSetAsideTree} << 52;
constexpr int tree_of(std::uint64_t key) {
  return static_cast<int>(key >> 52);
}
constexpr std::uint64_t code_of(std::uint64_t key) {
  return (key & ((std::uint64_t{1} << 52) - 1)) << 8;
}
/// The key of the directory's own list of chunks.
inline constexpr std::uint64_t kChunkListKey = std::uint64_t{kLastTree + 1} << 52;

/// Returns the name of a row in messages and `itin check`.
inline std::string place(const char* table, std::uint64_t key) {
  if (key == kChunkListKey) return fmt::format("{} list", table);
  return fmt::format("{} {}/{:013x}", table, tree_of(key), key & ((std::uint64_t{1} << 52) - 1));
}

}  // namespace itin::format
