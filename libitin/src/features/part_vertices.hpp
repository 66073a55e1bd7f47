// The heights of a raised part's vertices after its lines were made planar with all others: crossings have given it
// new ones.
#pragma once

#include <vector>

#include "features/raised_theme.hpp"

namespace itin {

struct PartVertex {
  GridPoint point;
  bool outline = false;  ///< between a feature and the ground
};

/// The part's own vertices and those at `ends` (any order, repetitions allowed), each once, in Morton order. A new one
/// lies within a grid step of some of the part's segments and has the greatest height of these there; of feet, where it
/// lies on one: what rises beside them is steep.
std::vector<PartVertex> part_vertices(const RaisedPart& part, const std::vector<Position>& ends);

}  // namespace itin
