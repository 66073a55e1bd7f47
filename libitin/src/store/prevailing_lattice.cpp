#include "store/prevailing_lattice.hpp"

#include <algorithm>
#include <cstdint>
#include <map>
#include <vector>

namespace itin {

namespace {

struct Vote {
  PostLattice lattice;
  std::uint64_t points = 0;
};

/// Returns the lattice that the index has recorded of a leaf whose points lie within the box; else that of those
/// within, as others may have spoilt the leaf's.
Vote vote_of(const PointIndex& index, const Leaf& leaf, const GridBox& box) {
  if (box.contains(intersection(leaf.cell.box(), index.bounds())))
    return {index.lattice_of(leaf).from_first_place(), leaf.points};
  WidestLattice widest;
  Vote vote;
  const auto block = index.unordered_block(leaf);
  for (const GridPoint& p : block->points)
    if (box.contains(p.x, p.y)) widest.add(p.x, p.y), ++vote.points;
  vote.lattice = widest.lattice().from_first_place();
  return vote;
}

}  // namespace

std::optional<PostLattice> prevailing_lattice(const PointIndex& index, std::span<const Leaf> leaves, const GridBox& box,
                                              std::size_t voters) {
  std::vector<Leaf> fullest(std::min(voters, leaves.size()));
  std::partial_sort_copy(leaves.begin(), leaves.end(), fullest.begin(), fullest.end(),
                         [](const Leaf& a, const Leaf& b) { return a.points > b.points; });
  std::map<PostLattice, std::uint64_t> votes;
  for (const Leaf& leaf : fullest) {
    const Vote vote = vote_of(index, leaf, box);
    votes[vote.lattice] += vote.points;
  }
  const auto most =
      std::max_element(votes.begin(), votes.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  return most == votes.end() ? std::nullopt : std::optional(most->first);
}

}  // namespace itin
