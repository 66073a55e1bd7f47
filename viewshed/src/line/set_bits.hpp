// The bits of a word that are set, one after the other: lines of a packet, members of a set.
#pragma once

#include <bit>
#include <concepts>

namespace itin::viewshed {

/// Calls visit(i) for the number of each set bit, the lowest first.
template <std::unsigned_integral Word, class Visit>
void for_each_bit(Word bits, const Visit& visit) {
  for (; bits != 0; bits &= bits - 1) visit(static_cast<unsigned>(std::countr_zero(bits)));
}

}  // namespace itin::viewshed
