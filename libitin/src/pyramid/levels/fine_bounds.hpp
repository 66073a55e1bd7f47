// The certificates of fine levels of rasters, by squares of posts.
#pragma once

#include <cstdint>
#include <vector>

#include <itin/progress.hpp>

#include "pyramid/difference/leaf_bounds.hpp"
#include "pyramid/levels/post_hierarchy.hpp"
#include "pyramid/points/working_index.hpp"

namespace itin {

/// Measures the fine levels of the hierarchy and writes their bounds, wherever their triangles follow from the posts
/// that they have: these are closed and away from all else. Nothing is triangulated. Returns the levels that are known
/// by leaf (bit k for level k). The others are left alone, and are for certify() to measure.
std::vector<unsigned> measure_fine_levels(const WorkingIndex& index, const std::vector<CurveRange>& tiles,
                                          const PostHierarchy& posts, LeafBounds& bounds, Progress& progress);

}  // namespace itin
