#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <itin/parallel.hpp>

#include "siting/choice/choice_state.hpp"
#include "siting/choice/greatest_gain.hpp"

namespace itin::viewshed {

namespace {

/// The least cost of gains that add up to `wanted`, where fractions of options count; all there is, where they do not.
double least_cost_of(std::vector<GainAtCost> gains_and_costs, double wanted) {
  sort_by_gain_for_cost(gains_and_costs);
  double cost = 0;
  for (const auto& [gain, whole] : gains_and_costs) {
    if (wanted <= 0) break;
    cost += whole * std::min(1.0, wanted / static_cast<double>(gain));
    wanted -= static_cast<double>(gain);
  }
  return cost;
}

/// Rounds a cost up to that of a whole number of options, where all cost the same.
double in_whole_options(const std::vector<SiteOption>& options, double cost) {
  const double one = options.front().cost;
  const bool alike = std::all_of(options.begin(), options.end(), [&](const SiteOption& o) { return o.cost == one; });
  return alike ? one * std::ceil(cost / one - 1e-9) : cost;
}

}  // namespace

double bound_cost(const ChoiceProblem& problem, std::span<const std::size_t> chosen) {
  // Whoever reaches the wanted value also reaches it together with a prefix of the choice: the gains that its sites
  // have after that prefix add up to what the prefix lacks, in elements served up to `cover` times.
  const int cover = problem.goal.cover;
  Served served(problem.demand, cover);
  Weight sum = 0;
  for (const DemandSet& set : problem.goal.existing) sum += served.gain(set), served.add(set);
  const auto all = static_cast<double>(cover) * static_cast<double>(*problem.goal.wanted + served.value());
  double bound = 0;
  for (std::size_t prefix = 0; prefix <= chosen.size(); ++prefix) {
    std::vector<Weight> gains(problem.options.size());
    parallel_for(gains.size(), [&](std::size_t i) { gains[i] = served.gain(problem.coverage.bounds(i).possible); });
    std::vector<GainAtCost> with_costs;
    for (std::size_t i = 0; i < gains.size(); ++i)
      if (gains[i] > 0) with_costs.emplace_back(gains[i], problem.options[i].cost);
    bound = std::max(bound, least_cost_of(std::move(with_costs), all - static_cast<double>(sum)) * (1 - 1e-12));
    if (prefix == chosen.size()) break;
    const CoverageBounds& bounds = problem.coverage.bounds(chosen[prefix]);
    sum += served.gain(bounds.possible);
    served.add(bounds.certain);
  }
  return in_whole_options(problem.options, bound);
}

}  // namespace itin::viewshed
