#include <algorithm>
#include <limits>
#include <optional>

#include <fmt/format.h>

#include <itin/error.hpp>

#include "siting/choice/choice_state.hpp"
#include "siting/choice/conflicts.hpp"
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
  std::optional<std::size_t> start{};  ///< the option that it began with
};

/// Chooses greedily and swaps, until neither changes anything.
Attempt attempt(const ChoiceProblem& problem, StepMeasure measure, std::vector<std::optional<Margin>>& closest) {
  Attempt result;
  std::vector<std::size_t>& chosen = result.chosen;
  extend_greedily(problem, measure, chosen, closest);
  if (!chosen.empty()) result.start = chosen.front();
  if (!problem.goal.exact_chosen || !problem.goal.swaps) return result;
  for (;;) {
    const std::size_t swaps = swap(problem, chosen);
    if (swaps + drop_idle(problem, chosen) == 0) break;
    result.swaps += swaps;
    extend_greedily(problem, measure, chosen, closest);
  }
  drop_needless(problem, chosen);
  return result;
}

/// Returns the measures to try. Under a budget they are gain per unit of cost and gain alone, since the better of the
/// two choices is within a constant factor of the best (Khuller, Moss and Naor 1999). Over a network gain per site is
/// tried too, since ways take several sites.
std::vector<StepMeasure> measures_for(const ChoiceGoal& goal) {
  std::vector<StepMeasure> measures;
  if (goal.budget) measures.push_back(StepMeasure::kGainPerCost);
  if (goal.network) measures.push_back(StepMeasure::kGainPerSite);
  measures.push_back(StepMeasure::kGain);
  return measures;
}

/// A part of the choices that are left to look among: choices of options that links may join.
struct Part {
  std::size_t number = 0;
  std::vector<bool> barred;  ///< all the other options
  Weight bound = 0;          ///< on the value
  std::size_t starts = 1;    ///< how many more attempts begin here
};

/// Attempts from several starts. Where no hub says where a choice begins, the best site by itself may be a dead end:
/// other starts follow, as long as a choice without the earlier ones can be better.
class Attempts {
 public:
  Attempts(const ChoiceProblem& problem, std::vector<std::optional<Margin>>& closest)
      : problem_(problem), closest_(closest), existing_(value_of(problem, {})) {
    const std::vector<std::vector<bool>> sets = separate_parts(problem);
    for (std::size_t number = 0; number < sets.size(); ++number) {
      Part part{.number = number, .barred = sets[number]};
      part.barred.flip();
      if (problem.goal.network && !problem.goal.network->hub()) part.starts = kStarts;
      rate(part);
      parts_.push_back(std::move(part));
    }
  }

  Attempt best() && {
    while (!parts_.empty()) {
      const auto next = std::max_element(parts_.begin(), parts_.end(),
                                         [](const Part& a, const Part& b) { return a.bound < b.bound; });
      if (!best_.chosen.empty() && next->bound < worth_) break;
      begin_in(*next);
      if (next->starts == 0) parts_.erase(next);
    }
    return std::move(best_);
  }

 private:
  static constexpr std::size_t kStarts = 8;

  void rate(Part& part) const {
    std::vector<bool> open = part.barred;
    open.flip();
    part.bound = bound_gains(problem_, open);
  }

  void begin_in(Part& part) {
    ChoiceProblem problem = problem_;
    problem.barred = part.barred;
    part.starts -= 1;
    for (const StepMeasure measure : measures_for(problem.goal)) {
      Attempt other = attempt(problem, measure, closest_);
      if (other.start) part.barred[*other.start] = true;
      if (!other.start) part.starts = 0;
      keep_better(std::move(other), part.number);
    }
    if (part.starts > 0) rate(part);
  }

  /// Among equals the earliest in the first part is kept, since the order of parts depends on bounds.
  void keep_better(Attempt other, std::size_t part) {
    const Weight worth = worth_of(other);
    if (other.chosen.empty()) return;
    if (!best_.chosen.empty() && (worth < worth_ || (worth == worth_ && part >= part_))) return;
    best_ = std::move(other), worth_ = worth, part_ = part;
  }
  Weight worth_of(const Attempt& attempt) const {
    const Weight value = value_of(problem_, attempt.chosen) - existing_;
    return problem_.goal.network && problem_.goal.wanted ? std::min(value, *problem_.goal.wanted) : value;
  }

  const ChoiceProblem& problem_;
  std::vector<std::optional<Margin>>& closest_;
  Weight existing_;
  std::vector<Part> parts_;
  Attempt best_;
  Weight worth_ = 0;
  std::size_t part_ = 0;
};

/// Orders sites as they gain most (or add least), each linked with the sites before it, and tells what each gains.
std::vector<ChosenSite> in_order(const ChoiceProblem& problem, std::vector<std::size_t> rest, bool keep) {
  ServedBounds served(problem, {});
  const Weight existing = served.least.value();
  const Weight sign = problem.goal.objective == Objective::kLeast ? -1 : 1;
  std::vector<ChosenSite> result;
  std::vector<std::size_t> order;
  while (!rest.empty()) {
    std::optional<std::size_t> best;
    Weight most = 0;
    for (std::size_t i = 0; i < rest.size() && !(keep && best); ++i) {
      const Weight gain = sign * served.least.gain(problem.coverage.bounds(rest[i]).certain);
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

/// Checks that the least can be asked of the options, and returns which of them exclude each other. Throws what
/// check_goal() throws for Objective::kLeast.
Conflicts checked_conflicts(const std::vector<SiteOption>& options, const ChoiceGoal& goal) {
  if (!goal.count || goal.budget || goal.wanted || goal.cover != 1 || goal.network || !goal.exact_chosen)
    throw InputError("the least is asked of a `count` of sites alone, whose coverage is exact", "count");
  Conflicts conflicts({options, goal, {}}, *goal.count);
  const std::size_t found = conflicts.fitting().size();
  if (found >= *goal.count) return conflicts;
  throw Error(fmt::format("`count`: {} asked for, but {}: `compatible` keeps the others apart", *goal.count,
                          found == conflicts.most()
                              ? fmt::format("no more than {} of {} sites can be chosen together", found, options.size())
                              : fmt::format("only {} of {} sites were found that can be chosen together, and no more "
                                            "than {} can",
                                            found, options.size(), conflicts.most())));
}

/// Checks as check_goal() does. Returns the conflicts for Objective::kLeast.
std::optional<Conflicts> checked(const std::vector<SiteOption>& options, const ChoiceGoal& goal) {
  if (!goal.count && !goal.budget && !goal.wanted)
    throw InputError("the choice has no end: give a count, a budget or a share of the demand", "count");
  if (goal.cover < 1 || goal.cover > 255) throw InputError("an element is served by 1 to 255 sites", "cover");
  for (const SiteOption& option : options)
    if (!(option.cost > 0)) throw InputError("the cost of a site must be a positive number");
  if (goal.objective == Objective::kLeast) return checked_conflicts(options, goal);
  if (!goal.network || !goal.network->hub()) return std::nullopt;
  const std::vector<bool> open = extensions({options, goal, {}}, {}, goal.count.value_or(options.size())).open;
  if (std::find(open.begin(), open.end(), true) == open.end())
    throw Error(
        "`hub`: no choice reaches it: no site that may be chosen has a clear link with it, or with an existing site "
        "that has; move it, or raise it or the masts");
  return std::nullopt;
}

}  // namespace

void check_goal(const std::vector<SiteOption>& options, const ChoiceGoal& goal) {
  checked(options, goal);
}

Choice choose(const Demand& demand, const std::vector<SiteOption>& options, Coverage& coverage, const ChoiceGoal& goal,
              Progress& progress) {
  const std::optional<Conflicts> conflicts = checked(options, goal);
  ChoiceProblem problem{{options, goal, {}}, demand, coverage, progress};
  const bool least = conflicts.has_value();
  if (least) problem.conflicts = &*conflicts;
  Choice choice;
  choice.closest.resize(options.size());
  Attempt best = Attempts(problem, choice.closest).best();
  LeastProof proof;
  if (least) proof = prove_least(problem, best.chosen);
  const BestOfFew of_few =
      !least && goal.exact_chosen && goal.swaps ? take_best_of_few(problem, best.chosen) : BestOfFew::kNotTried;
  if (of_few == BestOfFew::kBetter) ++best.swaps;
  choice.swaps = best.swaps + proof.swaps;
  choice.existing = value_of(problem, {});
  const bool in_greedy_order = choice.swaps == 0 && !goal.budget && !goal.network && !least;
  choice.chosen = in_order(problem, std::move(best.chosen), in_greedy_order);
  choice.value = choice.chosen.empty() ? 0 : choice.chosen.back().cumulative;
  choice.lower_bound = choice.upper_bound = choice.value;
  if (least) {
    choice.lower_bound = std::min(choice.value, proof.bound);
    return choice;
  }
  std::vector<std::size_t> order;
  for (const ChosenSite& site : choice.chosen) order.push_back(site.option);
  choice.cost = problem.cost_of(order);
  if (goal.wanted && choice.value >= *goal.wanted)
    choice.least_cost = std::min(choice.cost, bound_cost(problem, order));
  if (of_few == BestOfFew::kNotTried) choice.upper_bound = std::max(choice.value, bound_optimum(problem, order));
  return choice;
}

DemandSet served_elements(const Demand& demand, const std::vector<DemandSet>& sets, int cover) {
  Served served(demand, cover);
  for (const DemandSet& set : sets) served.add(set);
  return served.elements();
}

Weight served_by(const Demand& demand, const std::vector<DemandSet>& sets, int cover) {
  return demand.weight(served_elements(demand, sets, cover));
}

double gap_percent(const Choice& choice) {
  return choice.upper_bound == 0 ? 0
                                 : 100 * static_cast<double>(choice.upper_bound - choice.lower_bound) /
                                       static_cast<double>(choice.upper_bound);
}

double closeness(const Margin& margin, Objective objective) {
  const double tiny = std::numeric_limits<double>::min();
  return objective == Objective::kLeast ? margin.chosen / std::max(margin.upper, tiny)
                                        : margin.upper / std::max(margin.chosen, tiny);
}

}  // namespace itin::viewshed
