// Greedy choice in the plainest way.
//
//   test::greedy_by_brute_force(served_by_each, demand, 5)
#pragma once

#include <cstddef>
#include <vector>

#include <viewshed/siting.hpp>

namespace itin::test {

/// Returns the options in the order of their choice. Each is the first of the options that serve most together with the
/// ones before. There are fewer than `most` where no further option serves more.
inline std::vector<std::size_t> greedy_by_brute_force(const std::vector<viewshed::DemandSet>& served_by_each,
                                                      const viewshed::Demand& demand, std::size_t most) {
  std::vector<std::size_t> chosen;
  std::vector<viewshed::DemandSet> served;
  viewshed::Weight before = 0;
  while (chosen.size() < most) {
    viewshed::Weight best = before;
    std::size_t taken = 0;
    for (std::size_t i = 0; i < served_by_each.size(); ++i) {
      served.push_back(served_by_each[i]);
      const viewshed::Weight value = viewshed::served_by(demand, served, 1);
      served.pop_back();
      if (value > best) best = value, taken = i;
    }
    if (best == before) break;
    chosen.push_back(taken);
    served.push_back(served_by_each[taken]);
    before = best;
  }
  return chosen;
}

/// The demand that these options serve together.
inline viewshed::Weight value_of(const std::vector<std::size_t>& chosen,
                                 const std::vector<viewshed::DemandSet>& served_by_each,
                                 const viewshed::Demand& demand) {
  std::vector<viewshed::DemandSet> served;
  for (const std::size_t option : chosen) served.push_back(served_by_each[option]);
  return viewshed::served_by(demand, served, 1);
}

}  // namespace itin::test
