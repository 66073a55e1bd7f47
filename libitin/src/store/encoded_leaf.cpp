#include "store/encoded_leaf.hpp"

#include <algorithm>

#include <itin/box_of.hpp>

#include "store/block_codec.hpp"
#include "store/store_format.hpp"

namespace itin {

EncodedLeaf encode_leaf(int tree, const Cell& cell, std::span<const GridPoint> points,
                        std::span<const std::uint16_t> sources, std::int32_t lo, std::int32_t hi) {
  const auto count = static_cast<std::uint32_t>(points.size());
  EncodedLeaf encoded{{cell, tree, count, 0, 0, lo, hi, format::key(tree, cell.code)}, {}, 0, {}};
  if (points.empty()) return encoded;
  const auto [low, high] = std::minmax_element(points.begin(), points.end(),
                                               [](const GridPoint& a, const GridPoint& b) { return a.z < b.z; });
  encoded.leaf.zmin = low->z, encoded.leaf.zmax = high->z;
  encoded.bounds = box_of(points);
  encoded.vertices = count - static_cast<std::uint32_t>(std::count(sources.begin(), sources.end(), format::kMask));
  encoded.block = encode_block(cell, points, sources);
  return encoded;
}

}  // namespace itin
