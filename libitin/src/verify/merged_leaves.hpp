// The leaves of several quadtrees as one.
#pragma once

#include <vector>

#include "store/codec/point_index.hpp"

namespace itin {

/// Merges the leaves of two trees, each along the curve. Where leaves of both lists lie, the result has their common
/// parts, with the lesser `lo`, the greater `hi` and the key of the smaller cell (of the first list if they are equally
/// large). Elsewhere it has parts of the leaves of one list. The result is along the curve.
std::vector<Leaf> merged_leaves(const std::vector<Leaf>& first, const std::vector<Leaf>& second);

}  // namespace itin
