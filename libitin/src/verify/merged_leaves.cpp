#include "verify/merged_leaves.hpp"

#include <algorithm>
#include <span>

namespace itin {

namespace {

using Leaves = std::span<const Leaf>;

bool holds(Leaves leaves, const Cell& cell) {
  return leaves.size() == 1 && leaves.front().cell.contains(cell);
}

/// Returns the leaves in the cell, or the one that holds it.
Leaves within(Leaves leaves, const Cell& cell) {
  if (holds(leaves, cell)) return leaves;
  const auto ends_by = [](const Leaf& leaf, std::uint64_t code) { return leaf.cell.end() <= code; };
  const auto begin = std::lower_bound(leaves.begin(), leaves.end(), cell.code, ends_by);
  const auto starts_before = [](const Leaf& leaf, std::uint64_t code) { return leaf.cell.code < code; };
  const auto end = std::lower_bound(begin, leaves.end(), cell.end(), starts_before);
  return {begin, end};
}

Leaf both(const Cell& cell, Leaves first, Leaves second) {
  if (first.empty()) std::swap(first, second);
  Leaf leaf = first.front();
  if (!second.empty()) {
    const Leaf& other = second.front();
    if (other.cell.log2_side < leaf.cell.log2_side) leaf.key = other.key;
    leaf.lo = std::min(leaf.lo, other.lo), leaf.hi = std::max(leaf.hi, other.hi);
  }
  leaf.cell = cell;
  return leaf;
}

void merge_in(const Cell& cell, Leaves first, Leaves second, std::vector<Leaf>& merged) {
  if (first.empty() && second.empty()) return;
  if ((first.empty() || holds(first, cell)) && (second.empty() || holds(second, cell)))
    return merged.push_back(both(cell, first, second));
  for (int i = 0; i < 4; ++i) {
    const Cell child = cell.child(i);
    merge_in(child, within(first, child), within(second, child), merged);
  }
}

}  // namespace

std::vector<Leaf> merged_leaves(const std::vector<Leaf>& first, const std::vector<Leaf>& second) {
  if (second.empty()) return first;
  if (first.empty()) return second;
  Cell all = first.front().cell;
  for (const std::vector<Leaf>* leaves : {&first, &second})
    while (!all.contains(leaves->front().cell) || !all.contains(leaves->back().cell)) all = all.parent();
  std::vector<Leaf> merged;
  merge_in(all, first, second, merged);
  return merged;
}

}  // namespace itin
