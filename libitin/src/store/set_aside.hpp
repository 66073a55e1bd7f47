// Imported points and lines that the surface does not have unchanged, kept so that a later import finds all of them
// again. These are points of the ground that others replaced, that have no ground about them, or that a line's vertex
// covers; and lines that were cut, moved or left out. See libitin/FORMAT.md, "Set aside".
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/cell.hpp"
#include "store/codec/point_index.hpp"
#include "store/file/store_rows.hpp"
#include "store/segments/segment_features.hpp"

namespace itin {

/// A piece of a line as it was imported, a before b; at height 0 for themes that are not of the terrain.
struct ImportedSegment {
  GridPoint a, b;
  std::uint16_t source = 0;
  std::uint32_t feature = kNoFeature;  ///< the feature's number in the theme (segment_features.hpp)
  friend auto operator<=>(const ImportedSegment&, const ImportedSegment&) = default;
};

/// What is set aside of a theme's lines: its imported lines are its segments of the full surface less `made` plus
/// `imported`.
struct SetAsideLines {
  std::vector<ImportedSegment> imported;  ///< ascending
  std::vector<Segment> made;              ///< ascending, as the store has them; only their ends count
};

/// The numbers of points and segments that a store leaves out, and of crossings of its lines.
struct SetAsideCounts {
  std::uint64_t replaced = 0, isolated = 0;  ///< points
  std::uint64_t segments = 0;                ///< beyond the ground
  std::uint64_t crossings = 0;
};

struct SetAsideList {
  std::uint32_t point_blocks = 0;
  std::vector<std::uint32_t> line_blocks;  ///< by theme; themes without any may be missing
  SetAsideCounts counts;

  std::uint32_t blocks_of(std::uint16_t theme) const {
    return theme <= line_blocks.size() ? line_blocks[theme - std::size_t{1}] : 0;
  }
};

/// The most imported segments, made segments or points in a block.
inline constexpr std::size_t kSetAsideInBlock = 4096;

/// Encodes points as encode_block() does, but from any cell.
std::vector<std::uint8_t> encode_set_aside(const Cell& cell, std::span<const GridPoint> points,
                                           std::span<const std::uint16_t> sources);
std::vector<std::uint8_t> encode_set_aside(std::span<const ImportedSegment> imported, std::span<const Segment> made);
std::vector<std::uint8_t> encode_set_aside(const SetAsideList& list);

/// These throw CorruptStore.
SetAsideList set_aside_list(const StoreRows& rows);
Block set_aside_points(const StoreRows& rows, std::uint32_t block);
SetAsideLines set_aside_lines(const StoreRows& rows, std::uint16_t theme, std::uint32_t block);

}  // namespace itin
