// The leaves of several quadtrees as one.
#pragma once

#include <vector>

#include "store/point_index.hpp"

namespace itin {

/// Where leaves of both lists lie, which are each of one tree along the curve: their parts in common, with the lesser
/// `lo`, the greater `hi` and the key of the smaller cell (of the first list if they are as large); elsewhere parts of
/// the leaves that are there. Along the curve.
std::vector<Leaf> merged_leaves(const std::vector<Leaf>& first, const std::vector<Leaf>& second);

}  // namespace itin
