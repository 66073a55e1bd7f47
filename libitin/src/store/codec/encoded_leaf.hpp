// A leaf of points as StoreWriter writes it. Encoding is most of the work of writing, and many threads can do it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <itin/geometry.hpp>

#include "geometry/cell.hpp"
#include "store/codec/point_index.hpp"

namespace itin {

struct EncodedLeaf {
  Leaf leaf;
  GridBox bounds;                                ///< the box about the leaf's points
  std::uint32_t vertices = 0;                    ///< the leaf's points without those of source format::kMask
  std::vector<std::uint32_t> vertices_of_level;  ///< the number of each level, where the leaf is one of the ground
  std::vector<std::uint8_t> block;               ///< empty without points
};

/// Encodes a leaf of a tree. Takes `points` in Morton order, within the cell, possibly none, and as many sources; lo
/// and hi in grid units. Safe for concurrent use.
EncodedLeaf encode_leaf(int tree, const Cell& cell, std::span<const GridPoint> points,
                        std::span<const std::uint16_t> sources, std::int32_t lo, std::int32_t hi);

/// Encodes a leaf of the ground, whose points have these levels.
EncodedLeaf encode_ground(const Cell& cell, std::span<const GridPoint> points, std::span<const std::uint16_t> sources,
                          std::span<const std::uint8_t> levels);

/// Returns a leaf without its block: the points are stored elsewhere.
EncodedLeaf bare_leaf(int tree, const Cell& cell, std::span<const GridPoint> points, std::int32_t lo, std::int32_t hi);

}  // namespace itin
