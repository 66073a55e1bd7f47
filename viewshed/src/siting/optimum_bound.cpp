#include <algorithm>
#include <cmath>
#include <map>

#include <itin/parallel.hpp>

#include "choice_state.hpp"

namespace itin::viewshed {

namespace {

/// By at most this much, since fractions of options count, the sum of gains may be more.
Weight knapsack(std::vector<std::pair<Weight, double>> gains_and_costs, double budget) {
  std::sort(gains_and_costs.begin(), gains_and_costs.end(), [](const auto& a, const auto& b) {
    return static_cast<double>(a.first) * b.second > static_cast<double>(b.first) * a.second;
  });
  double sum = 0, rest = budget * (1 + 1e-12);
  for (const auto& [gain, cost] : gains_and_costs) {
    if (cost <= rest) {
      sum += static_cast<double>(gain);
      rest -= cost;
    } else {
      sum += static_cast<double>(gain) * rest / cost;
      break;
    }
  }
  return static_cast<Weight>(std::ceil(sum * (1 + 1e-12)));
}

/// The most that a choice gains on top of what is served already: gains only fall as sites are added (submodularity).
Weight greatest_gain(const ChoiceProblem& problem, const Served& served, std::size_t count) {
  std::vector<Weight> gains(problem.options.size());
  parallel_for(gains.size(),
               [&](std::size_t i) { gains[i] = served.gain(problem.coverage.bounds(i).possible); });
  std::map<std::size_t, Weight> of_place;
  std::vector<std::pair<Weight, double>> with_costs;
  for (std::size_t i = 0; i < gains.size(); ++i) {
    if (!problem.affordable(problem.options[i].cost)) continue;
    Weight& most = of_place[problem.options[i].place];
    most = std::max(most, gains[i]);
    with_costs.emplace_back(gains[i], problem.options[i].cost);
  }
  std::vector<Weight> best;
  for (const auto& [place, gain] : of_place) best.push_back(gain);
  std::sort(best.begin(), best.end(), std::greater<>());
  Weight sum = 0;
  for (std::size_t i = 0; i < std::min(count, best.size()); ++i) sum += best[i];
  if (problem.goal.budget) sum = std::min(sum, knapsack(std::move(with_costs), *problem.goal.budget));
  return sum;
}

}  // namespace

Weight bound_optimum(const ChoiceProblem& problem, std::span<const std::size_t> chosen) {
  const int cover = problem.goal.cover;
  std::size_t count = problem.options.size();
  if (problem.goal.count) count = *problem.goal.count;
  if (!problem.goal.count && !problem.goal.budget) count = chosen.size();

  Served everything(problem.demand, cover), served(problem.demand, cover);
  Weight sum = 0;  // of min(served, cover), at most
  for (const DemandSet& set : problem.goal.existing) {
    sum += served.gain(set);
    served.add(set);
    everything.add(set);
  }
  const Weight existing = served.value();
  for (std::size_t i = 0; i < problem.options.size(); ++i) everything.add(problem.coverage.bounds(i).possible);
  Weight bound = everything.value() - existing;
  for (std::size_t prefix = 0;; ++prefix) {
    bound = std::min(bound, (sum + greatest_gain(problem, served, count)) / cover - existing);
    if (prefix == chosen.size()) return bound;
    // With open bounds: what may be served counts in the sum, what certainly is leaves nothing to gain.
    const CoverageBounds& bounds = problem.coverage.bounds(chosen[prefix]);
    sum += served.gain(bounds.possible);
    served.add(bounds.certain);
  }
}

}  // namespace itin::viewshed
