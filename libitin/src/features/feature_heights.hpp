// Whether a store's features rise no higher above the ground than its index says.
#pragma once

#include <vector>

#include <itin/progress.hpp>
#include <itin/store.hpp>

namespace itin {

/// Compares the full surface with each standing theme to the bare one, at the vertices of both, in squares of 256 m:
/// memory follows these. One finding a theme and square at most. Throws Cancelled, and what triangulate() throws.
std::vector<Damage> features_above_their_heights(const Store& store, Progress& progress);

}  // namespace itin
