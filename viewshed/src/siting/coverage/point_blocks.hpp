// Points as elements of a demand: goes through the blocks of 64 that a site may serve.
#pragma once

#include <bit>
#include <cstdint>
#include <vector>

#include <viewshed/siting.hpp>

namespace itin::viewshed {

/// One bit per point of a block.
struct ServedPoints {
  std::uint64_t certain = 0, never = 0;
};

/// Calls judge(first point, the open ones as bits) -> ServedPoints for every block of `before.possible`; the open
/// points are those that `before` leaves open. Returns the number of open points.
template <class Judge>
std::uint64_t judge_points(const CoverageBounds& before, CoverageBounds& after, const Judge& judge) {
  std::uint64_t asked = 0;
  auto certain = before.certain.blocks().begin();
  for (const DemandSet::Block& block : before.possible.blocks()) {
    while (certain != before.certain.blocks().end() && certain->number < block.number) ++certain;
    const bool any = certain != before.certain.blocks().end() && certain->number == block.number;
    const std::uint64_t known = any ? certain->members : 0, open = block.members & ~known;
    const ServedPoints served = judge(std::size_t{64} * block.number, open);
    after.certain.add(block.number, known | served.certain);
    after.possible.add(block.number, block.members & ~served.never);
    asked += static_cast<std::uint64_t>(std::popcount(open));
  }
  return asked;
}

}  // namespace itin::viewshed
