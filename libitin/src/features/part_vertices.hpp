// The heights of a raised part's vertices after its lines were made planar with all others. Crossings have given the
// part new vertices.
#pragma once

#include <vector>

#include "features/raised_theme.hpp"

namespace itin {

struct PartVertex {
  GridPoint point;
  bool outline = false;  ///< whether it lies between a feature and the ground
};

/// Returns the part's own vertices and those at `ends` (any order, repetitions allowed), each once, in Morton order. A
/// new vertex lies within a grid step of some of the part's segments and takes their greatest height there. Where it
/// lies on feet only these count, for what rises beside them is steep.
std::vector<PartVertex> part_vertices(const RaisedPart& part, const std::vector<Position>& ends);

}  // namespace itin
