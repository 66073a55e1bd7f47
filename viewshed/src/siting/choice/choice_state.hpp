// A choice on its way: what is given, what is chosen so far, and what the next site would gain, between bounds.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include <itin/progress.hpp>
#include <viewshed/siting.hpp>

#include "siting/choice/served.hpp"

namespace itin::viewshed {

/// What may be chosen, whatever it serves.
struct ChoiceRules {
  const std::vector<SiteOption>& options;
  const ChoiceGoal& goal;
  std::vector<bool> barred{};  ///< options that are left out; empty: none is

  bool is_barred(std::size_t option) const { return !barred.empty() && barred[option]; }
  bool may_join(std::size_t option, std::span<const std::size_t> chosen) const {
    return !goal.compatible ||
           std::all_of(chosen.begin(), chosen.end(), [&](std::size_t c) { return goal.compatible(option, c); });
  }
  /// Tells whether a whole choice is allowed, apart from its cost.
  bool holds_together(std::span<const std::size_t> chosen) const;
  double cost_of(std::span<const std::size_t> chosen) const {
    double sum = 0;
    for (const std::size_t option : chosen) sum += options[option].cost;
    return sum;
  }
  /// Sums of costs are compared with this slack, so that a budget of three times 0.1 buys three.
  bool affordable(double cost) const { return !goal.budget || cost <= *goal.budget * (1 + 1e-12); }
  bool place_taken(std::size_t option, std::span<const std::size_t> chosen) const {
    for (const std::size_t other : chosen)
      if (options[other].place == options[option].place) return true;
    return false;
  }
};

class Conflicts;

struct ChoiceProblem : ChoiceRules {
  const Demand& demand;
  Coverage& coverage;
  Progress& progress;
  const Conflicts* conflicts = nullptr;  ///< given for Objective::kLeast

  void refine_fully(std::size_t option) const {
    while (!coverage.bounds(option).exact) coverage.refine({&option, 1});
  }
};

/// The demand that the chosen sites serve besides existing ones: certainly, and perhaps.
struct ServedBounds {
  Served least, most;

  ServedBounds(const ChoiceProblem& problem, std::span<const std::size_t> chosen)
      : least(problem.demand, problem.goal.cover), most(least) {
    for (const DemandSet& set : problem.goal.existing) least.add(set), most.add(set);
    for (const std::size_t option : chosen) add(problem.coverage.bounds(option));
  }
  void add(const CoverageBounds& bounds) { least.add(bounds.certain), most.add(bounds.possible); }
};

/// The measure that greedy steps are compared by: a step takes an option, over a network with the relays on its way.
enum class StepMeasure { kGain, kGainPerSite, kGainPerCost };

/// Adds sites to `chosen` until the goal is reached or nothing is gained: the best by the measure, or the one that adds
/// least. `closest` is kept up to date.
void extend_greedily(const ChoiceProblem& problem, StepMeasure measure, std::vector<std::size_t>& chosen,
                     std::vector<std::optional<Margin>>& closest);

/// Exchanges chosen sites for better ones, the best exchange first, until none gains. Returns the number of exchanges.
/// Every chosen site must be exact.
std::size_t swap(const ChoiceProblem& problem, std::vector<std::size_t>& chosen);

/// Looks at every choice within the goal where a count allows only few, and puts the best in place of `chosen` where
/// that is better. Every option becomes exact then.
enum class BestOfFew { kNotTried, kWasBest, kBetter };
BestOfFew take_best_of_few(const ChoiceProblem& problem, std::vector<std::size_t>& chosen);

/// Leaves out sites, the least useful first, as long as the wanted value is reached without them.
void drop_needless(const ChoiceProblem& problem, std::vector<std::size_t>& chosen);

/// Gives up sites that serve nothing by themselves and that no link needs. Returns how many.
std::size_t drop_idle(const ChoiceProblem& problem, std::vector<std::size_t>& chosen);

/// Searches for a better choice where the least is wanted, puts it in place of `chosen` where there is one, and returns
/// a bound on the value of every choice within the goal. Every chosen site must be exact.
struct LeastProof {
  Weight bound = 0;
  std::size_t swaps = 0;  ///< the exchanges that followed
};
LeastProof prove_least(const ChoiceProblem& problem, std::vector<std::size_t>& chosen);

/// A bound on the value of every choice of `open` options within the goal, by their gains alone.
Weight bound_gains(const ChoiceProblem& problem, const std::vector<bool>& open);

/// A bound on the cost of every choice that reaches the goal's wanted value, found from the gains that are left after
/// each prefix of `chosen`. O(prefixes times options) gains.
double bound_cost(const ChoiceProblem& problem, std::span<const std::size_t> chosen);

/// A bound on the value of every choice within the goal, found from choices that begin with a prefix of `chosen`.
Weight bound_optimum(const ChoiceProblem& problem, std::span<const std::size_t> chosen);

}  // namespace itin::viewshed
