#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "siting/choice/choice_state.hpp"

namespace itin::viewshed {

namespace {

/// Up to kFewChoices are always tried. Up to kManyChoices are tried where every option is exact, and where that takes
/// no more than kMostVisits visits to elements, some seconds.
constexpr std::uint64_t kFewChoices = 1000;
constexpr std::uint64_t kManyChoices = 1000000, kMostVisits = 1000000000;

/// How many choices of one to `count` of the options there are, or more than kManyChoices.
std::uint64_t choices_of(std::uint64_t options, std::uint64_t count) {
  std::uint64_t all = 0, of_size = 1;
  for (std::uint64_t size = 1; size <= std::min(count, options) && all <= kManyChoices; ++size) {
    of_size = of_size * (options - size + 1) / size;
    all += of_size;
  }
  return all;
}

bool may_try_all(const ChoiceProblem& problem) {
  const ChoiceGoal& goal = problem.goal;
  if (!goal.count || goal.wanted || goal.network) return false;
  const std::uint64_t options = problem.options.size(), choices = choices_of(options, *goal.count);
  if (choices <= kFewChoices) return true;
  if (choices > kManyChoices) return false;
  std::uint64_t elements = 0;
  for (std::size_t option = 0; option < options; ++option) {
    const CoverageBounds& bounds = problem.coverage.bounds(option);
    if (!bounds.exact) return false;
    elements += bounds.certain.size();
  }
  return elements / options * choices <= kMostVisits;
}

class EveryChoice {
 public:
  EveryChoice(const ChoiceProblem& problem, Weight known)
      : problem_(problem), served_(ServedBounds(problem, {}).least), best_value_(known) {}

  /// Returns the best choice, the first among equals; empty where none is better than what is known. Throws Cancelled.
  std::vector<std::size_t> best() && {
    extend(0, served_.value());
    return std::move(best_);
  }

 private:
  /// Extends the choice, which has this value, by options from `first` on.
  void extend(std::size_t first, Weight so_far) {
    for (std::size_t option = first; option < problem_.options.size(); ++option) {
      if (problem_.place_taken(option, choice_) || !problem_.may_join(option, choice_) ||
          !problem_.affordable(problem_.cost_of(choice_) + problem_.options[option].cost))
        continue;
      if (choice_.empty()) problem_.progress.throw_if_cancelled();
      const DemandSet& set = problem_.coverage.bounds(option).certain;
      const Weight value = so_far + served_.completed_by(set);
      choice_.push_back(option);
      if (value > best_value_) best_ = choice_, best_value_ = value;
      if (choice_.size() < *problem_.goal.count) {
        served_.add(set);
        extend(option + 1, value);
        served_.remove(set);
      }
      choice_.pop_back();
    }
  }

  const ChoiceProblem& problem_;
  Served served_;
  std::vector<std::size_t> choice_, best_;
  Weight best_value_ = 0;
};

}  // namespace

BestOfFew take_best_of_few(const ChoiceProblem& problem, std::vector<std::size_t>& chosen) {
  if (!may_try_all(problem)) return BestOfFew::kNotTried;
  for (std::size_t option = 0; option < problem.options.size(); ++option) problem.refine_fully(option);
  std::vector<std::size_t> best = EveryChoice(problem, ServedBounds(problem, chosen).least.value()).best();
  if (best.empty()) return BestOfFew::kWasBest;
  chosen = std::move(best);
  return BestOfFew::kBetter;
}

}  // namespace itin::viewshed
