#include <algorithm>

#include <itin/error.hpp>

#include "siting/choice/choice_state.hpp"

namespace itin::viewshed {

namespace {

void validate(const ChoiceProblem& problem) {
  const ChoiceGoal& goal = problem.goal;
  if (!goal.count && !goal.budget && !goal.wanted)
    throw InputError("the choice has no end: give a count, a budget or a share of the demand");
  if (goal.cover < 1 || goal.cover > 255) throw InputError("an element is served by 1 to 255 sites");
  for (const SiteOption& option : problem.options)
    if (!(option.cost > 0)) throw InputError("the cost of a site must be a positive number");
}

Weight value_of(const ChoiceProblem& problem, std::span<const std::size_t> chosen) {
  return ServedBounds(problem, chosen).least.value();
}

/// Greedy, and swaps until neither changes anything.
std::vector<std::size_t> choose_by(const ChoiceProblem& problem, bool per_cost, Choice& choice) {
  std::vector<std::size_t> chosen;
  extend_greedily(problem, per_cost, chosen, choice.closest);
  if (!problem.goal.exact_chosen || !problem.goal.swaps) return chosen;
  while (const std::size_t swaps = swap(problem, chosen)) {
    choice.swaps += swaps;
    extend_greedily(problem, per_cost, chosen, choice.closest);
  }
  drop_needless(problem, chosen);
  return chosen;
}

/// The order in which they gain most, with what they gain.
std::vector<ChosenSite> in_order(const ChoiceProblem& problem, std::vector<std::size_t> rest, bool keep) {
  ServedBounds served(problem, {});
  const Weight existing = served.least.value();
  std::vector<ChosenSite> result;
  Weight before = 0;
  while (!rest.empty()) {
    std::size_t best = 0;
    for (std::size_t i = 1; i < rest.size() && !keep; ++i) {
      const Weight gain = served.least.gain(problem.coverage.bounds(rest[i]).certain),
                   most = served.least.gain(problem.coverage.bounds(rest[best]).certain);
      if (gain > most || (gain == most && rest[i] < rest[best])) best = i;
    }
    served.add(problem.coverage.bounds(rest[best]));
    const Weight now = served.least.value() - existing;
    result.push_back({.option = rest[best], .gain = now - before, .cumulative = now});
    before = now;
    rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(best));
  }
  return result;
}

}  // namespace

Choice choose(const Demand& demand, const std::vector<SiteOption>& options, Coverage& coverage, const ChoiceGoal& goal,
              Progress& progress) {
  const ChoiceProblem problem{demand, options, coverage, goal, progress};
  validate(problem);
  Choice choice;
  choice.closest.resize(options.size());
  std::vector<std::size_t> chosen = choose_by(problem, goal.budget.has_value(), choice);
  if (goal.budget) {
    // By gain alone: the better of both is within a constant factor of the best (Khuller, Moss and Naor 1999).
    const std::size_t swaps = choice.swaps;
    std::vector<std::size_t> other = choose_by(problem, false, choice);
    const bool better = value_of(problem, other) > value_of(problem, chosen);
    choice.swaps = better ? choice.swaps - swaps : swaps;
    if (better) chosen = std::move(other);
  }
  choice.existing = value_of(problem, {});
  choice.chosen = in_order(problem, chosen, choice.swaps == 0 && !goal.budget);
  choice.value = choice.chosen.empty() ? 0 : choice.chosen.back().cumulative;
  std::vector<std::size_t> order;
  for (const ChosenSite& site : choice.chosen) order.push_back(site.option);
  choice.upper_bound = std::max(choice.value, bound_optimum(problem, order));
  return choice;
}

Weight served_by(const Demand& demand, const std::vector<DemandSet>& sets, int cover) {
  Served served(demand, cover);
  for (const DemandSet& set : sets) served.add(set);
  return served.value();
}

double gap_percent(const Choice& choice) {
  return choice.upper_bound == 0
             ? 0
             : 100 * static_cast<double>(choice.upper_bound - choice.value) / static_cast<double>(choice.upper_bound);
}

}  // namespace itin::viewshed
