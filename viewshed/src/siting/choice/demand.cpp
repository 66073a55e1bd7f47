#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include <itin/error.hpp>
#include <viewshed/demand.hpp>

#include "line/set_bits.hpp"

namespace itin::viewshed {

namespace {

/// Sums up to this stay whole in a double too.
constexpr double kGreatestSum = 0x1p53;
constexpr double kFinestUnit = 0x1p-30;

}  // namespace

std::size_t DemandSet::size() const {
  return std::accumulate(blocks_.begin(), blocks_.end(), std::size_t{0}, [](std::size_t sum, const Block& block) {
    return sum + static_cast<std::size_t>(std::popcount(block.members));
  });
}

bool DemandSet::contains(std::size_t element) const {
  const auto number = static_cast<std::uint32_t>(element / 64);
  const auto block = std::lower_bound(blocks_.begin(), blocks_.end(), number,
                                      [](const Block& b, std::uint32_t n) { return b.number < n; });
  return block != blocks_.end() && block->number == number && (block->members >> (element % 64) & 1) != 0;
}

DemandSet intersection(const DemandSet& a, const DemandSet& b) {
  DemandSet result;
  auto other = b.blocks().begin();
  for (const DemandSet::Block& block : a.blocks()) {
    while (other != b.blocks().end() && other->number < block.number) ++other;
    if (other == b.blocks().end()) break;
    if (other->number == block.number) result.add(block.number, block.members & other->members);
  }
  return result;
}

DemandSet set_union(const DemandSet& a, const DemandSet& b) {
  DemandSet result;
  auto x = a.blocks().begin(), y = b.blocks().begin();
  while (x != a.blocks().end() || y != b.blocks().end()) {
    const bool from_a = y == b.blocks().end() || (x != a.blocks().end() && x->number <= y->number);
    const bool from_b = x == a.blocks().end() || (y != b.blocks().end() && y->number <= x->number);
    const std::uint32_t number = from_a ? x->number : y->number;
    result.add(number, (from_a ? x++->members : 0) | (from_b ? y++->members : 0));
  }
  return result;
}

DemandSet difference(const DemandSet& a, const DemandSet& b) {
  DemandSet result;
  auto other = b.blocks().begin();
  for (const DemandSet::Block& block : a.blocks()) {
    while (other != b.blocks().end() && other->number < block.number) ++other;
    const bool both = other != b.blocks().end() && other->number == block.number;
    result.add(block.number, both ? block.members & ~other->members : block.members);
  }
  return result;
}

Demand::Demand(const std::vector<double>& weights) : count_(weights.size()) {
  double sum = 0;
  bool whole = true;
  for (const double weight : weights) {
    if (!(std::isfinite(weight) && weight >= 0))
      throw InputError(fmt::format("a weight of the demand is {:g}: weights are 0 or positive numbers", weight));
    sum += weight;
    whole = whole && weight == std::floor(weight);
  }
  if (sum >= kGreatestSum / 2) throw InputError("the weights of the demand are too great: give them in a larger unit");
  if (!whole) {
    unit_ = kFinestUnit;
    while (sum / unit_ >= kGreatestSum / 2) unit_ *= 2;
  }
  weights_.reserve(count_);
  for (const double weight : weights) weights_.push_back(std::llround(weight / unit_));
}

Weight Demand::weight(std::uint32_t block, std::uint64_t members) const {
  if (weights_.empty()) return std::popcount(members);
  Weight sum = 0;
  for_each_bit(members, [&](unsigned bit) { sum += weights_[std::size_t{64} * block + bit]; });
  return sum;
}

Weight Demand::weight(const DemandSet& set) const {
  Weight sum = 0;
  for (const DemandSet::Block& block : set.blocks()) sum += weight(block.number, block.members);
  return sum;
}

Weight Demand::total() const {
  if (weights_.empty()) return static_cast<Weight>(count_);
  return std::accumulate(weights_.begin(), weights_.end(), Weight{0});
}

Weight Demand::at_least(double value) const {
  return static_cast<Weight>(std::ceil(value / unit_));
}

}  // namespace itin::viewshed
