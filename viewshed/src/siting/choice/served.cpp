#include "siting/choice/served.hpp"

#include <utility>

#include "line/set_bits.hpp"

namespace itin::viewshed {

Weight Served::gain(std::span<const DemandSet* const> sets) const {
  if (sets.size() == 1) return gain(*sets.front());
  // Layer number n holds what more than n of the sets hold.
  std::vector<DemandSet> layers;
  for (const DemandSet* set : sets) {
    DemandSet carry = *set;
    for (DemandSet& layer : layers) {
      DemandSet both = intersection(layer, carry);
      layer = set_union(layer, carry);
      carry = std::move(both);
    }
    if (!carry.empty()) layers.push_back(std::move(carry));
  }
  Weight sum = 0;
  for (std::size_t n = 0; n < layers.size(); ++n) {
    DemandSet helped;
    for (const DemandSet::Block& block : layers[n].blocks()) {
      std::uint64_t members = 0;
      for_each_bit(block.members, [&](unsigned bit) {
        if (counts_[std::size_t{64} * block.number + bit] + n < static_cast<std::size_t>(cover_))
          members |= std::uint64_t{1} << bit;
      });
      helped.add(block.number, members);
    }
    sum += demand_->weight(helped);
  }
  return sum;
}

}  // namespace itin::viewshed
