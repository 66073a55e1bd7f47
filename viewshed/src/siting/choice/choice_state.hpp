// A choice on its way: what is given, what is chosen so far, and what the next site would gain, between bounds.
#pragma once

#include <span>
#include <vector>

#include <itin/progress.hpp>
#include <viewshed/siting.hpp>

#include "siting/choice/served.hpp"

namespace itin::viewshed {

struct ChoiceProblem {
  const Demand& demand;
  const std::vector<SiteOption>& options;
  Coverage& coverage;
  const ChoiceGoal& goal;
  Progress& progress;

  bool may_join(std::size_t option, std::span<const std::size_t> chosen) const {
    return !goal.may_join || goal.may_join(option, chosen);
  }
  bool holds_together(std::span<const std::size_t> chosen) const {
    return !goal.holds_together || goal.holds_together(chosen);
  }
  void refine_fully(std::size_t option) const {
    while (!coverage.bounds(option).exact) coverage.refine({&option, 1});
  }
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

/// Adds sites to `chosen` until the goal is reached or nothing is gained: the best by gain, or by gain a unit of cost.
/// `closest` is kept up to date.
void extend_greedily(const ChoiceProblem& problem, bool per_cost, std::vector<std::size_t>& chosen,
                     std::vector<std::optional<Margin>>& closest);

/// Exchanges chosen sites for better ones, the best exchange first, until none gains. Returns how many. Every chosen
/// one must be exact.
std::size_t swap(const ChoiceProblem& problem, std::vector<std::size_t>& chosen);

/// Leaves out sites, the least useful first, as long as the wanted value is reached without them.
void drop_needless(const ChoiceProblem& problem, std::vector<std::size_t>& chosen);

/// A bound on the value of every choice within the goal, from those that begin with a prefix of `chosen`.
Weight bound_optimum(const ChoiceProblem& problem, std::span<const std::size_t> chosen);

}  // namespace itin::viewshed
