#include "features/mesh/entangled.hpp"

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "features/plan/planarity.hpp"

namespace itin {

namespace {

using Meeting = std::pair<std::uint32_t, std::uint32_t>;  ///< two owners that meet

/// Takes owners away, the one with most meetings first.
class Untangling {
 public:
  explicit Untangling(const std::vector<Meeting>& meetings) : left_(meetings.size()) {
    for (const auto& [a, b] : meetings) {
      others_[a].push_back(b);
      if (a != b) others_[b].push_back(a);
    }
    for (const auto& [owner, others] : others_) order_.insert({others.size(), owner});
  }

  /// Calls gone(owner, meetings) for each owner that goes.
  template <class Gone>
  void run(std::uint64_t most, const Gone& gone) {
    while (left_ > most) {
      const auto [count, owner] = *order_.rbegin();
      gone(owner, count);
      left_ -= count;
      order_.erase({count, owner});
      const std::vector<std::uint32_t> others = std::move(others_.at(owner));
      others_.erase(owner);
      for (const std::uint32_t other : others)
        if (other != owner) drop_meeting(other, owner);
    }
  }

 private:
  void drop_meeting(std::uint32_t owner, std::uint32_t with) {
    const auto found = others_.find(owner);
    if (found == others_.end()) return;
    std::vector<std::uint32_t>& others = found->second;
    const std::size_t before = others.size();
    std::erase(others, with);  // all of them: the next calls find nothing
    if (others.size() == before) return;
    order_.erase({before, owner});
    order_.insert({others.size(), owner});
  }

  std::uint64_t left_;
  std::map<std::uint32_t, std::vector<std::uint32_t>> others_;  ///< whom each owner meets, once for every meeting
  std::set<std::pair<std::size_t, std::uint32_t>> order_;       ///< how many meetings each owner has, and the owner
};

}  // namespace

std::map<std::uint32_t, std::string> entangled(std::span<const Patch> patches, std::span<const std::uint32_t> owners) {
  std::vector<GridEdge> edges;
  std::vector<std::uint32_t> owner_of_edge;
  for (std::size_t i = 0; i < patches.size(); ++i) {
    for (const GridPolygon& polygon : patches[i].plan) {
      for_each_edge(polygon, [&](Position a, Position b) { edges.emplace_back(a, b); });
      owner_of_edge.resize(edges.size(), owners[i]);
    }
  }
  const std::uint64_t most = most_conflicts(edges.size());
  std::map<std::uint32_t, std::string> result;
  if (count_conflicts(edges, most) <= most) return result;
  std::vector<Meeting> meetings;
  visit_conflicts(edges, [&](std::uint32_t i, std::uint32_t j) {
    meetings.emplace_back(owner_of_edge[i], owner_of_edge[j]);
    return meetings.size() < kCountedConflicts;
  });
  Untangling(meetings).run(most, [&](std::uint32_t owner, std::uint64_t count) {
    result[owner] = fmt::format(
        "left out: its outline crosses itself and its neighbours {} times, where no more than {} crossings of {} edges "
        "are taken apart",
        count, most, edges.size());
  });
  return result;
}

}  // namespace itin
