#include <algorithm>
#include <cmath>
#include <map>

#include <itin/parallel.hpp>

#include "siting/choice/choice_state.hpp"
#include "siting/choice/greatest_gain.hpp"
#include "siting/choice/ways.hpp"

namespace itin::viewshed {

namespace {

/// An upper bound on the sum of gains within the budget, in which fractions of options count.
Weight knapsack(std::vector<GainAtCost> gains_and_costs, double budget) {
  sort_by_gain_for_cost(gains_and_costs);
  double sum = 0, rest = budget;
  for (const auto& [gain, cost] : gains_and_costs) {
    if (cost <= rest) {
      sum += static_cast<double>(gain);
      rest -= cost;
    } else {
      sum += static_cast<double>(gain) * std::max(rest, 0.0) / cost;
      break;
    }
  }
  return static_cast<Weight>(std::ceil(sum * (1 + 1e-12)));
}

}  // namespace

void sort_by_gain_for_cost(std::vector<GainAtCost>& options) {
  std::sort(options.begin(), options.end(), [](const GainAtCost& a, const GainAtCost& b) {
    return static_cast<double>(a.first) * b.second > static_cast<double>(b.first) * a.second;
  });
}

GreatestGain greatest_gain(const ChoiceProblem& problem, const Served& served, const std::vector<bool>& open,
                           std::size_t count, double spent) {
  std::vector<Weight> gains(problem.options.size());
  parallel_for(gains.size(), [&](std::size_t i) {
    if (open[i] && problem.affordable(spent + problem.options[i].cost))
      gains[i] = served.gain(problem.coverage.bounds(i).possible);
  });
  GreatestGain result;
  std::map<std::size_t, Weight> of_place;
  std::vector<GainAtCost> with_costs;
  for (std::size_t i = 0; i < gains.size(); ++i) {
    if (gains[i] == 0) continue;
    if (gains[i] > gains[result.best]) result.best = i;
    Weight& most = of_place[problem.options[i].place];
    most = std::max(most, gains[i]);
    with_costs.emplace_back(gains[i], problem.options[i].cost);
  }
  std::vector<Weight> best;
  for (const auto& [place, gain] : of_place) best.push_back(gain);
  std::sort(best.begin(), best.end(), std::greater<>());
  for (std::size_t i = 0; i < std::min(count, best.size()); ++i) result.sum += best[i];
  if (problem.goal.budget) {
    const double left = *problem.goal.budget * (1 + 1e-12) - spent;
    result.sum = std::min(result.sum, knapsack(std::move(with_costs), left));
  }
  return result;
}

Weight bound_gains(const ChoiceProblem& problem, const std::vector<bool>& open) {
  Served served(problem.demand, problem.goal.cover);
  Weight sum = 0;
  for (const DemandSet& set : problem.goal.existing) sum += served.gain(set), served.add(set);
  const Weight existing = served.value();
  sum += greatest_gain(problem, served, open, problem.goal.count.value_or(problem.options.size()), 0).sum;
  return sum / problem.goal.cover - existing;
}

Weight bound_optimum(const ChoiceProblem& problem, std::span<const std::size_t> chosen) {
  const int cover = problem.goal.cover;
  std::size_t count = problem.options.size();
  if (problem.goal.count) count = *problem.goal.count;
  if (!problem.goal.count && !problem.goal.budget) count = chosen.size();

  Served everything(problem.demand, cover), served(problem.demand, cover);
  Weight sum = 0, known = 0;  // min(served, cover) summed over all elements: at most, and at least
  for (const DemandSet& set : problem.goal.existing) {
    sum += served.gain(set);
    served.add(set);
    everything.add(set);
  }
  known = sum;
  const Weight existing = served.value();
  const std::vector<bool> open = extensions(problem, {}, count).open;
  for (std::size_t i = 0; i < problem.options.size(); ++i)
    if (open[i] || !problem.goal.network) everything.add(problem.coverage.bounds(i).possible);
  Weight bound = everything.value() - existing;
  const auto tighten = [&](Weight most) { bound = std::min(bound, most / cover - existing); };
  for (const std::size_t option : chosen) {
    tighten(sum + greatest_gain(problem, served, open, count, 0).sum);
    // Bounds may be open: what may be served counts in the sum, and what certainly is served leaves nothing to gain.
    const CoverageBounds& bounds = problem.coverage.bounds(option);
    sum += served.gain(bounds.possible);
    known += served.gain(bounds.certain);
    served.add(bounds.certain);
  }
  tighten(sum + greatest_gain(problem, served, open, count, 0).sum);
  tighten(search_optimum(problem, count, known));
  if (problem.goal.network) {
    // A search that branches at what gains most, rather than along ways, gets farther where links hinder little.
    ChoiceGoal goal = problem.goal;
    goal.network.reset();
    ChoiceProblem unlinked{{problem.options, goal, open}, problem.demand, problem.coverage, problem.progress};
    unlinked.barred.flip();
    tighten(search_optimum(unlinked, count, known));
  }
  return bound;
}

}  // namespace itin::viewshed
