// How much ground there is about a box, told by the directory of the leaves alone.
#pragma once

#include <cstdint>
#include <numeric>
#include <vector>

#include "geometry/cell.hpp"
#include "store/codec/point_index.hpp"

namespace itin {

/// Returns how many points of all levels the leaves have that meet a box.
inline std::uint64_t points_of_leaves(const PointIndex& index, const GridBox& box) {
  std::vector<Leaf> leaves;
  index.leaves({}, box, leaves);
  return std::accumulate(leaves.begin(), leaves.end(), std::uint64_t{0},
                         [](std::uint64_t sum, const Leaf& leaf) { return sum + leaf.points; });
}

}  // namespace itin
