// How many of some sites serve each element of a demand.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <viewshed/demand.hpp>

namespace itin::viewshed {

class Served {
 public:
  /// An element is served once `cover` sites serve it.
  Served(const Demand& demand, int cover)
      : demand_(&demand),
        cover_(cover),
        counts_(64 * demand.block_count()),
        enough_(demand.block_count()),
        nearly_(demand.block_count(), cover == 1 ? ~std::uint64_t{0} : 0) {}

  void add(const DemandSet& set) {
    for_each_element(set, [&](std::size_t element) {
      const int count = ++counts_[element];
      if (count == cover_) enough_[element / 64] |= std::uint64_t{1} << (element % 64);
      if (count == cover_ - 1) nearly_[element / 64] |= std::uint64_t{1} << (element % 64);
    });
  }
  /// Removes a set that was added before.
  void remove(const DemandSet& set) {
    for_each_element(set, [&](std::size_t element) {
      const int count = counts_[element]--;
      if (count == cover_) enough_[element / 64] &= ~(std::uint64_t{1} << (element % 64));
      if (count == cover_ - 1) nearly_[element / 64] &= ~(std::uint64_t{1} << (element % 64));
    });
  }

  /// The weight of the set's elements that one more site still helps.
  Weight gain(const DemandSet& set) const {
    Weight sum = 0;
    for (const DemandSet::Block& block : set.blocks()) {
      const std::uint64_t open = block.members & ~enough_[block.number];
      if (open != 0) sum += demand_->weight(block.number, open);
    }
    return sum;
  }
  /// How much value() grows if the set is added: the weight of its elements that one more site serves.
  Weight completed_by(const DemandSet& set) const {
    Weight sum = 0;
    for (const DemandSet::Block& block : set.blocks()) {
      const std::uint64_t last = block.members & nearly_[block.number] & ~enough_[block.number];
      if (last != 0) sum += demand_->weight(block.number, last);
    }
    return sum;
  }
  /// The gain of several sets together: the sum over elements of as many of them as still help.
  Weight gain(std::span<const DemandSet* const> sets) const;
  /// The weight of the elements that enough sites serve, those of elements().
  Weight value() const {
    Weight sum = 0;
    for (std::size_t b = 0; b < enough_.size(); ++b)
      if (enough_[b] != 0) sum += demand_->weight(static_cast<std::uint32_t>(b), enough_[b]);
    return sum;
  }
  DemandSet elements() const {
    DemandSet set;
    for (std::size_t b = 0; b < enough_.size(); ++b) set.add(static_cast<std::uint32_t>(b), enough_[b]);
    return set;
  }
  bool enough(std::size_t element) const { return (enough_[element / 64] >> (element % 64) & 1) != 0; }

 private:
  const Demand* demand_;
  int cover_;
  std::vector<std::uint16_t> counts_;
  std::vector<std::uint64_t> enough_;  ///< elements that `cover` sites serve
  std::vector<std::uint64_t> nearly_;  ///< elements that one site less serves, and the elements of enough_
};

}  // namespace itin::viewshed
