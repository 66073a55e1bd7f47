// The most that further sites can gain, whatever they are.
#pragma once

#include <utility>
#include <vector>

#include "siting/choice/choice_state.hpp"

namespace itin::viewshed {

struct GreatestGain {
  Weight sum = 0;        ///< `count` sites gain no more than this: gains only fall as sites are added (submodularity)
  std::size_t best = 0;  ///< the option that alone gains most
};

/// Bounds the gain of at most `count` `open` options of different places, within what the budget leaves after `spent`.
GreatestGain greatest_gain(const ChoiceProblem& problem, const Served& served, const std::vector<bool>& open,
                           std::size_t count, double spent);

/// What an option gains, and what it costs.
using GainAtCost = std::pair<Weight, double>;
/// Puts those first that gain most for their cost.
void sort_by_gain_for_cost(std::vector<GainAtCost>& options);

/// Searches by branch and bound from the best bound down, for a second or so. Returns a bound on the sum of min(served,
/// cover) of every choice of `count` sites within the budget, and the optimum itself in small cases. `known` is the sum
/// that some choice has.
Weight search_optimum(const ChoiceProblem& problem, std::size_t count, Weight known);

}  // namespace itin::viewshed
