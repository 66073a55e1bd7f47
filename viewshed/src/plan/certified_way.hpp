// How a viewshed at a coarse level is made certain.
#pragma once

#include <cstdint>

#include <itin/store.hpp>
#include <viewshed/viewshed.hpp>

namespace itin::viewshed {

enum class CertifiedWay {
  kExactly,    ///< over the full surface, where the level asked for is no cheaper
  kByBlocks,   ///< over the level as a whole, block by block
  kBySectors,  ///< over the level, sector by sector about each observer
};

/// Exactly for level 0 itself, for levels that leave out little, where the exact answer costs less, and for levels that
/// are too large for the memory, but for a small share of a vast surface. It follows from the whole
/// request, not from a segment of it, nor from the memory that there is: what a level leaves undecided would follow it,
/// too.
CertifiedWay certified_way(const Store& store, const Request& request);

/// Points of the level that are looked at together in a sector.
inline constexpr std::uint64_t kPointsOfSector = 750000;

}  // namespace itin::viewshed
