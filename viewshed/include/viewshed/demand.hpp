// The demand that sites are to serve: cells or points with weights, and sets of them.
//
//   const viewshed::Demand demand({3.0, 1.0, 2.5});  // three households
//   viewshed::DemandSet served;
//   served.add(0, 0b101);  // the first and the third
//   const double people = demand.in_metric(demand.weight(served));
//
// Weights are kept as whole numbers of a unit (1 where all are whole, else a power of two small enough), so that sums
// do not depend on their order and comparisons of bounds with exact values are exact.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace itin::viewshed {

using Weight = std::int64_t;

/// A set of elements of a demand, 64 per block; only blocks with a member are kept, in ascending order.
class DemandSet {
 public:
  struct Block {
    std::uint32_t number = 0;
    std::uint64_t members = 0;
    friend bool operator==(const Block&, const Block&) = default;
  };

  /// Block numbers must ascend; a block without members is left out.
  void add(std::uint32_t block, std::uint64_t members) {
    if (members != 0) blocks_.push_back({block, members});
  }
  const std::vector<Block>& blocks() const { return blocks_; }
  bool empty() const { return blocks_.empty(); }
  std::size_t size() const;
  bool contains(std::size_t element) const;
  friend bool operator==(const DemandSet&, const DemandSet&) = default;

 private:
  std::vector<Block> blocks_;
};

/// Calls visit(element) for each member, in ascending order.
template <class Visit>
void for_each_element(const DemandSet& set, const Visit& visit) {
  for (const DemandSet::Block& block : set.blocks())
    for (std::uint64_t rest = block.members; rest != 0; rest &= rest - 1)
      visit(std::size_t{64} * block.number + static_cast<std::size_t>(std::countr_zero(rest)));
}

/// Contains the members of both. O(blocks).
DemandSet intersection(const DemandSet& a, const DemandSet& b);
/// Contains the members of either. O(blocks).
DemandSet set_union(const DemandSet& a, const DemandSet& b);
/// Contains the members of the first that the second does not have. O(blocks).
DemandSet difference(const DemandSet& a, const DemandSet& b);

/// The weights of a demand's elements: 1 each, or one given for each.
class Demand {
 public:
  Demand() = default;
  explicit Demand(std::size_t count) : count_(count) {}
  /// Throws InputError for a weight that is negative or not finite, and where their sum is too great to be exact.
  explicit Demand(const std::vector<double>& weights);

  std::size_t size() const { return count_; }
  std::size_t block_count() const { return (count_ + 63) / 64; }
  Weight weight(std::uint32_t block, std::uint64_t members) const;
  Weight weight(const DemandSet& set) const;
  Weight total() const;
  /// Converts a weight to the units of the weights given.
  double in_metric(Weight weight) const { return static_cast<double>(weight) * unit_; }
  /// The least weight that is not below the value.
  Weight at_least(double value) const;

 private:
  std::size_t count_ = 0;
  std::vector<Weight> weights_;  ///< empty: 1 each
  double unit_ = 1;
};

}  // namespace itin::viewshed
