// A leaf of points as StoreWriter writes it. Encoding is most of the work of writing, and can be done by many threads.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <itin/geometry.hpp>

#include "geometry/cell.hpp"
#include "store/point_index.hpp"

namespace itin {

struct EncodedLeaf {
  Leaf leaf;
  GridBox bounds;                   ///< the box about its points
  std::uint32_t vertices = 0;       ///< its points without those of source format::kMask
  std::vector<std::uint8_t> block;  ///< empty without points
};

/// `points` in Morton order, within the cell, possibly none; as many sources. lo and hi in grid units. Safe for
/// concurrent use.
EncodedLeaf encode_leaf(int tree, const Cell& cell, std::span<const GridPoint> points,
                        std::span<const std::uint16_t> sources, std::int32_t lo, std::int32_t hi);

}  // namespace itin
