// The pairing of half-edges, from which all other topology follows.
#pragma once

#include <cstdint>
#include <vector>

#include <itin/tin.hpp>
#include <itin/topology.hpp>

namespace itin {

/// Returns for each half-edge its twin, or kNoNeighbour at the boundary. O(n).
std::vector<std::uint32_t> twin_half_edges(const Tin& tin);

}  // namespace itin
