// Tells whether something lies wholly on the ground of a store, by the outline of what the store's sources cover.
#pragma once

#include <vector>

#include <itin/store.hpp>

#include "features/mesh/terrain_heights.hpp"
#include "features/plan/plan_overlay.hpp"
#include "store/codec/point_index.hpp"

namespace itin {

/// The segments of the outline that may meet the box.
std::vector<Segment> outline_near(const Store& ground, const GridBox& box);

/// Whether all of a polygon is ground: it touches no outline, and one of its positions is ground.
bool lies_on_ground(const GridPolygon& polygon, const std::vector<Segment>& outline, const TerrainHeights& terrain);

}  // namespace itin
