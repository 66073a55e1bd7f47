#include "store/codec/encoded_leaf.hpp"

#include <algorithm>

#include <itin/box_of.hpp>

#include "store/codec/block_codec.hpp"
#include "store/codec/store_format.hpp"

namespace itin {

EncodedLeaf bare_leaf(int tree, const Cell& cell, std::span<const GridPoint> points, std::int32_t lo, std::int32_t hi) {
  EncodedLeaf encoded;
  encoded.leaf = {cell, tree, static_cast<std::uint32_t>(points.size()), 0, 0, lo, hi, format::key(tree, cell.code)};
  if (points.empty()) return encoded;
  const auto [low, high] = std::minmax_element(points.begin(), points.end(),
                                               [](const GridPoint& a, const GridPoint& b) { return a.z < b.z; });
  encoded.leaf.zmin = low->z, encoded.leaf.zmax = high->z;
  encoded.bounds = box_of(points);
  return encoded;
}

EncodedLeaf encode_leaf(int tree, const Cell& cell, std::span<const GridPoint> points,
                        std::span<const std::uint16_t> sources, std::int32_t lo, std::int32_t hi) {
  EncodedLeaf encoded = bare_leaf(tree, cell, points, lo, hi);
  if (points.empty()) return encoded;
  encoded.vertices =
      encoded.leaf.points - static_cast<std::uint32_t>(std::count(sources.begin(), sources.end(), format::kMask));
  encoded.block = encode_block(cell, points, sources);
  return encoded;
}

EncodedLeaf encode_ground(const Cell& cell, std::span<const GridPoint> points, std::span<const std::uint16_t> sources,
                          std::span<const std::uint8_t> levels) {
  EncodedLeaf encoded = bare_leaf(format::kGroundTree, cell, points, 0, 0);
  if (points.empty()) return encoded;
  encoded.vertices = encoded.leaf.points;
  for (const std::uint8_t level : levels) {
    if (level >= encoded.vertices_of_level.size()) encoded.vertices_of_level.resize(level + std::size_t{1}, 0);
    ++encoded.vertices_of_level[level];
  }
  encoded.block = encode_block(cell, points, sources, levels);
  return encoded;
}

}  // namespace itin
