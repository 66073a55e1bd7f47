// How a viewshed at a coarse level is made certain.
#pragma once

#include <cstdint>

#include <itin/store.hpp>
#include <viewshed/request.hpp>

namespace itin::viewshed {

enum class CertifiedWay {
  kExactly,    ///< over the full surface, where the level asked for is no cheaper
  kByBlocks,   ///< over the level as a whole, block by block
  kBySectors,  ///< over the level, sector by sector about each observer
};

/// Chooses the way. It is kExactly for level 0 itself, for levels that leave out little, where the exact answer costs
/// less, and for levels that are too large for the memory, unless they are a small share of a vast surface. The choice
/// depends on the whole request, not on a segment of it, nor on the memory that there is: otherwise, what a level
/// leaves undecided would depend on these, too.
CertifiedWay certified_way(const Store& store, const Request& request);

/// Points of the level that are looked at together in a sector.
inline constexpr std::uint64_t kPointsOfSector = 750000;

}  // namespace itin::viewshed
