// Points of the ground that lines of the terrain pass through between their vertices. A line keeps its heights there,
// as it does at its vertices: it gets a vertex at each, which takes the point's place.
//
// Lines are led through these points as they were imported, and once more when they are planar, for crossings have
// moved them by up to half a grid step.
#pragma once

#include <cstdint>
#include <vector>

#include <itin/progress.hpp>

#include "features/plan/planar.hpp"
#include "pyramid/points/sorted_points.hpp"

namespace itin {

/// Splits those of the segments whose owners are of the terrain. Reads the points near them once.
void lead_through_points(const SortedPoints& points, const std::vector<bool>& terrain,
                         std::vector<OwnedSegment>& segments, Progress& progress);

/// Splits all edges, where edges of owners of the terrain pass through points. Owners beyond `terrain` are not of it.
void lead_through_points(const SortedPoints& points, const std::vector<bool>& terrain, PlanarLines& lines,
                         Progress& progress);

}  // namespace itin
