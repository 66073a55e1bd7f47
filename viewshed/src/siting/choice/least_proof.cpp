#include <algorithm>
#include <iterator>

#include "siting/choice/choice_state.hpp"
#include "siting/choice/least_search.hpp"

namespace itin::viewshed {

namespace {

/// How many classes of the demand are looked at, over all searches: a second or so.
constexpr double kLeastWork = 3e8;

/// What the options serve by themselves, besides existing sites.
std::vector<Weight> gains_alone(const ChoiceProblem& problem) {
  const ServedBounds nothing(problem, {});
  std::vector<Weight> gains;
  for (std::size_t option = 0; option < problem.options.size(); ++option)
    gains.push_back(nothing.least.gain(problem.coverage.bounds(option).certain));
  return gains;
}

Weight net_value(const ChoiceProblem& problem, const std::vector<std::size_t>& chosen) {
  return ServedBounds(problem, chosen).least.value() - ServedBounds(problem, {}).least.value();
}

/// Searches on the lower bounds of coverage.
LeastAnswer search_on_bounds(const ChoiceProblem& problem, Weight known, double work) {
  const std::vector<Weight> gains = gains_alone(problem);
  std::vector<bool> open(gains.size());
  std::vector<std::size_t> options;
  for (std::size_t option = 0; option < gains.size(); ++option) {
    open[option] = gains[option] < known;
    if (open[option]) options.push_back(option);
  }
  const SharedDemand demand = shared_demand(problem, open);
  return search_least({*problem.conflicts, demand, std::move(options), *problem.goal.count, known}, work,
                      problem.progress);
}

}  // namespace

LeastProof prove_least(const ChoiceProblem& problem, std::vector<std::size_t>& chosen) {
  LeastProof proof;
  double work = kLeastWork;
  for (;;) {
    const LeastAnswer answer = search_on_bounds(problem, net_value(problem, chosen), work);
    work -= answer.work;
    proof.bound = std::max(proof.bound, answer.bound);
    if (!answer.better) return proof;
    std::vector<std::size_t> uncertain;
    std::copy_if(answer.better->begin(), answer.better->end(), std::back_inserter(uncertain),
                 [&](std::size_t option) { return !problem.coverage.bounds(option).exact; });
    if (!uncertain.empty()) {
      if (work <= 0) return proof;
      problem.coverage.refine(uncertain);
      continue;
    }
    chosen = *answer.better;
    if (problem.goal.swaps) proof.swaps += swap(problem, chosen);
  }
}

}  // namespace itin::viewshed
