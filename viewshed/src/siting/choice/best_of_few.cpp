#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "siting/choice/choice_state.hpp"

namespace itin::viewshed {

namespace {

constexpr std::uint64_t kFewChoices = 1000;

/// How many choices of one to `count` of the options there are, or more than kFewChoices.
std::uint64_t choices_of(std::uint64_t options, std::uint64_t count) {
  std::uint64_t all = 0, of_size = 1;
  for (std::uint64_t size = 1; size <= std::min(count, options) && all <= kFewChoices; ++size) {
    of_size = of_size * (options - size + 1) / size;
    all += of_size;
  }
  return all;
}

class EveryChoice {
 public:
  EveryChoice(const ChoiceProblem& problem, Weight known)
      : problem_(problem), served_(ServedBounds(problem, {}).least), best_value_(known) {}

  /// Returns the best choice, the first among equals; empty where none is better than what is known.
  std::vector<std::size_t> best() && {
    extend(0);
    return std::move(best_);
  }

 private:
  /// Extends the choice by options from this one on.
  void extend(std::size_t first) {
    for (std::size_t option = first; option < problem_.options.size(); ++option) {
      if (problem_.place_taken(option, choice_) || !problem_.may_join(option, choice_) ||
          !problem_.affordable(problem_.cost_of(choice_) + problem_.options[option].cost))
        continue;
      const DemandSet& set = problem_.coverage.bounds(option).certain;
      choice_.push_back(option);
      served_.add(set);
      if (const Weight value = served_.value(); value > best_value_) best_ = choice_, best_value_ = value;
      if (choice_.size() < *problem_.goal.count) extend(option + 1);
      served_.remove(set);
      choice_.pop_back();
    }
  }

  const ChoiceProblem& problem_;
  Served served_;
  std::vector<std::size_t> choice_, best_;
  Weight best_value_ = 0;
};

}  // namespace

bool take_best_of_few(const ChoiceProblem& problem, std::vector<std::size_t>& chosen) {
  const ChoiceGoal& goal = problem.goal;
  if (!goal.count || goal.wanted || goal.network || choices_of(problem.options.size(), *goal.count) > kFewChoices)
    return false;
  for (std::size_t option = 0; option < problem.options.size(); ++option) problem.refine_fully(option);
  std::vector<std::size_t> best = EveryChoice(problem, ServedBounds(problem, chosen).least.value()).best();
  if (best.empty()) return false;
  chosen = std::move(best);
  return true;
}

}  // namespace itin::viewshed
