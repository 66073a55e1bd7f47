// Tells whether segments meet only at their ends, exactly, in integers.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "features/plan/plan_overlay.hpp"

namespace itin {

/// Returns the pairs of indices of edges that have more in common than one end of each, or are the same edge. The pairs
/// are ascending, each comes once. O((n + k) log n) while edges are not much denser than 64 in 256 grid steps.
std::vector<std::pair<std::uint32_t, std::uint32_t>> conflicts(std::span<const GridEdge> edges);

/// Calls visit(i, j) for every place where edges i and j cross, or touch other than at ends of both, until it returns
/// false. An edge that is given twice is visited as one. Memory is a few times that of the edges.
void visit_conflicts(std::span<const GridEdge> edges, const std::function<bool(std::uint32_t, std::uint32_t)>& visit);

/// Counts the places that visit_conflicts() visits, until there are more than `most`.
std::uint64_t count_conflicts(std::span<const GridEdge> edges, std::uint64_t most);

/// The most conflicts at which outlines are taken apart. Time and memory follow the number of places where outlines
/// meet each other or themselves, which grows with the square of the edges. No real outline comes near.
constexpr std::uint64_t most_conflicts(std::size_t edges) {
  return std::max<std::uint64_t>(20'000, 2 * std::uint64_t{edges});
}
/// Counting stops at this many conflicts.
inline constexpr std::uint64_t kCountedConflicts = 5'000'000;

}  // namespace itin
