// Whether segments meet only at their ends: exactly, in integers.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "features/plan_overlay.hpp"

namespace itin {

/// Pairs of indices of edges that have more in common than one end of each, or are the same edge, ascending. Each pair
/// once. O((n + k) log n) while edges are not much denser than 64 in 256 grid steps.
std::vector<std::pair<std::uint32_t, std::uint32_t>> conflicts(std::span<const GridEdge> edges);

}  // namespace itin
