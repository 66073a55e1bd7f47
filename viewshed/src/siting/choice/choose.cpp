#include <algorithm>

#include <itin/error.hpp>

#include "siting/choice/choice_state.hpp"
#include "siting/choice/greatest_gain.hpp"
#include "siting/choice/ways.hpp"

namespace itin::viewshed {

namespace {

Weight value_of(const ChoiceProblem& problem, std::span<const std::size_t> chosen) {
  return ServedBounds(problem, chosen).least.value();
}

struct Attempt {
  std::vector<std::size_t> chosen;
  std::size_t swaps = 0;
};

/// Greedy, and swaps until neither changes anything.
Attempt attempt(const ChoiceProblem& problem, StepMeasure measure, const std::vector<bool>& barred,
                std::vector<std::optional<Margin>>& closest) {
  Attempt result;
  std::vector<std::size_t>& chosen = result.chosen;
  extend_greedily(problem, measure, barred, chosen, closest);
  if (!problem.goal.exact_chosen || !problem.goal.swaps) return result;
  for (;;) {
    const std::size_t swaps = swap(problem, chosen);
    if (swaps + drop_idle(problem, chosen) == 0) break;
    result.swaps += swaps;
    extend_greedily(problem, measure, barred, chosen, closest);
  }
  drop_needless(problem, chosen);
  return result;
}

/// Options that links may join, and what a choice among them can be worth.
struct Part {
  std::size_t number = 0;
  std::vector<bool> barred;  ///< all the others
  Weight bound = 0;
};

/// The most promising first.
std::vector<Part> parts_of(const ChoiceProblem& problem) {
  std::vector<std::vector<bool>> sets = separate_parts(problem);
  if (sets.size() == 1) return {Part{}};
  std::vector<Part> parts;
  for (std::vector<bool>& set : sets) {
    const Weight bound = bound_gains(problem, set);
    set.flip();
    parts.push_back({parts.size(), std::move(set), bound});
  }
  std::stable_sort(parts.begin(), parts.end(), [](const Part& a, const Part& b) { return a.bound > b.bound; });
  return parts;
}

/// The best attempt, of equals the first: in each part of the network that may hold a better one, and under a budget by
/// gain per unit of cost and by gain alone, of which the better is within a constant factor of the best (Khuller, Moss
/// and Naor 1999).
Attempt best_attempt(const ChoiceProblem& problem, std::vector<std::optional<Margin>>& closest) {
  std::vector<StepMeasure> measures{StepMeasure::kGain};
  if (problem.goal.network) measures.insert(measures.begin(), StepMeasure::kGainPerSite);
  if (problem.goal.budget) measures.insert(measures.begin(), StepMeasure::kGainPerCost);
  Attempt best;
  const Weight existing = value_of(problem, {});
  Weight value = existing;
  std::size_t best_part = 0;
  for (const Part& part : parts_of(problem)) {
    const bool enough = problem.goal.wanted && value - existing >= *problem.goal.wanted;
    if (!best.chosen.empty() && (enough || part.bound < value - existing)) break;
    for (const StepMeasure measure : measures) {
      Attempt other = attempt(problem, measure, part.barred, closest);
      const Weight reached = value_of(problem, other.chosen);
      if (!best.chosen.empty() && (reached < value || (reached == value && part.number >= best_part))) continue;
      best = std::move(other), value = reached, best_part = part.number;
    }
  }
  return best;
}

/// The order in which they gain most, each linked with those before it, and what they gain.
std::vector<ChosenSite> in_order(const ChoiceProblem& problem, std::vector<std::size_t> rest, bool keep) {
  ServedBounds served(problem, {});
  const Weight existing = served.least.value();
  std::vector<ChosenSite> result;
  std::vector<std::size_t> order;
  while (!rest.empty()) {
    std::optional<std::size_t> best;
    Weight most = 0;
    for (std::size_t i = 0; i < rest.size() && !(keep && best); ++i) {
      const Weight gain = served.least.gain(problem.coverage.bounds(rest[i]).certain);
      if (best && (gain < most || (gain == most && rest[i] > rest[*best]))) continue;
      order.push_back(rest[i]);
      if (problem.holds_together(order)) best = i, most = gain;
      order.pop_back();
    }
    order.push_back(rest[*best]);
    served.add(problem.coverage.bounds(order.back()));
    const Weight before = result.empty() ? 0 : result.back().cumulative, now = served.least.value() - existing;
    result.push_back({.option = order.back(), .gain = now - before, .cumulative = now});
    rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(*best));
  }
  return result;
}

}  // namespace

void check_goal(const std::vector<SiteOption>& options, const ChoiceGoal& goal) {
  if (!goal.count && !goal.budget && !goal.wanted)
    throw InputError("the choice has no end: give a count, a budget or a share of the demand");
  if (goal.cover < 1 || goal.cover > 255) throw InputError("an element is served by 1 to 255 sites");
  for (const SiteOption& option : options)
    if (!(option.cost > 0)) throw InputError("the cost of a site must be a positive number");
  if (!goal.network || !goal.network->hub()) return;
  const std::vector<bool> open = extensions({options, goal}, {}, {}, goal.count.value_or(options.size())).open;
  if (std::find(open.begin(), open.end(), true) == open.end())
    throw Error(
        "`hub`: no choice reaches it: no site that may be chosen has a clear link with it, or with an existing site "
        "that has; move it, or raise it or the masts");
}

Choice choose(const Demand& demand, const std::vector<SiteOption>& options, Coverage& coverage, const ChoiceGoal& goal,
              Progress& progress) {
  check_goal(options, goal);
  const ChoiceProblem problem{{options, goal}, demand, coverage, progress};
  Choice choice;
  choice.closest.resize(options.size());
  Attempt best = best_attempt(problem, choice.closest);
  choice.swaps = best.swaps;
  choice.existing = value_of(problem, {});
  choice.chosen = in_order(problem, std::move(best.chosen), choice.swaps == 0 && !goal.budget && !goal.network);
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
