// A cell of a quadtree that makes a false statement about the surfaces in it.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "store/codec/point_index.hpp"
#include "verify/height_difference.hpp"

namespace itin {

struct FalseCell {
  int tree = 0;
  std::optional<Leaf> leaf;  ///< none: a leaf is missing
  Extremes differs;          ///< the difference of the two surfaces in the cell
};

/// Merges the findings of several tiles about the same cells; in the order of trees and of the curve.
inline std::vector<FalseCell> merged(const std::vector<FalseCell>& found) {
  constexpr std::uint64_t kMissing = ~std::uint64_t{0};
  std::map<std::pair<int, std::uint64_t>, FalseCell> by_place;
  for (const FalseCell& cell : found) {
    const auto [at, fresh] = by_place.try_emplace({cell.tree, cell.leaf ? cell.leaf->cell.code : kMissing}, cell);
    if (!fresh) at->second.differs.add(cell.differs);
  }
  std::vector<FalseCell> all;
  for (const auto& [place, cell] : by_place) all.push_back(cell);
  return all;
}

}  // namespace itin
