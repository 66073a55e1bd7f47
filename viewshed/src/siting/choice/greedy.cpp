#include <algorithm>
#include <cmath>

#include <itin/parallel.hpp>

#include "line/infinity.hpp"
#include "siting/choice/choice_state.hpp"
#include "siting/choice/conflicts.hpp"
#include "siting/choice/ways.hpp"

namespace itin::viewshed {

namespace {

/// The gain of an option with the relays on its way, by the measure of steps; negative where the least is wanted.
struct Bid {
  std::size_t option = 0;
  double upper = 0;
  double lower = 0;
  bool open = false;  ///< may be taken at all

  friend bool operator<(const Bid& a, const Bid& b) {
    return a.upper != b.upper ? a.upper > b.upper : a.option < b.option;
  }
  /// Whether this one is taken before the other, whatever their true gains are.
  bool surely_before(const Bid& other) const {
    return lower > other.upper || (lower == other.upper && option < other.option);
  }
};

class Greedy {
 public:
  Greedy(const ChoiceProblem& problem, StepMeasure measure, std::vector<std::size_t>& chosen,
         std::vector<std::optional<Margin>>& closest)
      : problem_(problem),
        measure_(measure),
        chosen_(chosen),
        closest_(closest),
        served_(problem, chosen),
        ways_(next_ways()) {
    if (least()) room_.emplace(*problem.conflicts, *problem.goal.count);
    for (const std::size_t option : chosen)
      if (room_) room_->take(option);
  }

  void run() {
    while (!reached()) {
      problem_.progress.throw_if_cancelled();
      report();
      const std::optional<Bid> next = best();
      if (!next) return;
      take(*next);
    }
  }

 private:
  bool least() const { return problem_.goal.objective == Objective::kLeast; }
  bool reached() const {
    const ChoiceGoal& goal = problem_.goal;
    if (goal.count && chosen_.size() >= *goal.count) return true;
    if (!goal.wanted) return false;
    Served none(problem_.demand, goal.cover);
    for (const DemandSet& set : goal.existing) none.add(set);
    return served_.least.value() - none.value() >= *goal.wanted;
  }

  void report() const {
    if (problem_.goal.count)
      problem_.progress.report("choice",
                               static_cast<double>(chosen_.size()) / static_cast<double>(*problem_.goal.count));
  }

  Ways next_ways() const {
    const WayRules rules{.most_sites = problem_.goal.count.value_or(problem_.options.size()),
                         .by_cost = measure_ == StepMeasure::kGainPerCost};
    return ways_to_options(problem_, chosen_, rules);
  }

  double unit_of(const Way& way) const {
    if (measure_ == StepMeasure::kGain) return 1;
    return measure_ == StepMeasure::kGainPerCost ? way.cost : static_cast<double>(way.sites);
  }

  Bid bid(std::size_t option) const {
    const std::optional<Way>& way = ways_[option];
    if (!way) return {.option = option};
    std::vector<const DemandSet*> certain, possible;
    bool exact = all_exact_;
    for (const std::size_t site : ways_.to(option)) {
      const CoverageBounds& bounds = problem_.coverage.bounds(site);
      certain.push_back(&bounds.certain), possible.push_back(&bounds.possible);
      exact = exact && bounds.exact;
    }
    if (least()) {
      const double most = -static_cast<double>(served_.least.gain(certain));
      return {.option = option,
              .upper = most,
              .lower = exact ? most : -static_cast<double>(served_.least.gain(possible)),
              .open = true};
    }
    const double unit = unit_of(*way);
    const double upper = static_cast<double>(served_.least.gain(possible)) / unit;
    const double lower = exact ? upper : static_cast<double>(served_.most.gain(certain)) / unit;
    return {.option = option, .upper = upper, .lower = lower, .open = true};
  }

  std::vector<Bid> all_bids() {
    ways_ = next_ways();
    all_exact_ = std::all_of(chosen_.begin(), chosen_.end(),
                             [&](std::size_t option) { return problem_.coverage.bounds(option).exact; });
    std::vector<Bid> bids(problem_.options.size());
    parallel_for(bids.size(), [&](std::size_t i) { bids[i] = bid(i); });
    return bids;
  }

  bool joins(const Bid& b) { return problem_.may_join(b.option, chosen_) && (!room_ || room_->left_by(b.option)); }

  /// Returns the option that exact coverage would choose; nothing where none gains.
  std::optional<Bid> best() {
    std::vector<Bid> bids = all_bids();
    for (;;) {
      std::vector<Bid> order;
      std::copy_if(bids.begin(), bids.end(), std::back_inserter(order),
                   [&](const Bid& b) { return b.open && (least() || b.upper > 0); });
      std::sort(order.begin(), order.end());
      const auto may_join = [&](const Bid& b) { return joins(b); };
      const auto first = std::find_if(order.begin(), order.end(), may_join);
      if (first == order.end()) return std::nullopt;
      // An option whose gain may be nothing is not taken before its gain is known.
      const auto second = std::find_if(first + 1, order.end(), may_join);
      if ((least() || first->lower > 0) && (second == order.end() || first->surely_before(*second))) {
        remember(order, *first);
        return *first;
      }
      refine({first, order.end()}, bids);
    }
  }

  /// Refines the first of the order and the options that may come before it.
  void refine(std::span<const Bid> order, std::vector<Bid>& bids) {
    std::vector<std::size_t> batch;
    double known = -kInfinity;
    for (const Bid& b : order.first(std::min(order.size(), 4 * problem_.goal.batch))) {
      if (b.upper < known || batch.size() >= problem_.goal.batch) break;
      if (joins(b)) add_open(ways_.to(b.option), batch);
      known = std::max(known, b.lower);
    }
    if (!batch.empty()) {
      problem_.coverage.refine(batch);
      for (Bid& b : bids) b = bid(b.option);
      return;
    }
    // Both are exact, but what the chosen sites serve is not.
    add_open(chosen_, batch);
    problem_.coverage.refine(batch);
    served_ = ServedBounds(problem_, chosen_);
    bids = all_bids();
  }

  /// Adds the options whose bounds are open.
  void add_open(std::span<const std::size_t> options, std::vector<std::size_t>& batch) const {
    for (const std::size_t option : options)
      if (!problem_.coverage.bounds(option).exact && std::find(batch.begin(), batch.end(), option) == batch.end())
        batch.push_back(option);
  }

  void remember(const std::vector<Bid>& order, const Bid& taken) {
    using enum Margin::Outcome;
    for (const Bid& b : order) {
      const bool near = !problem_.may_join(b.option, chosen_);
      if (b.option == taken.option || (near && taken < b)) continue;
      const Margin::Outcome outcome = taken < b ? kOutbid : near ? kTooNear : kNoRoom;
      remember(b.option, {std::abs(b.upper), std::abs(taken.lower), chosen_.size(), outcome});
    }
  }

  /// Keeps the step at which the option came nearest: the first at which a rule alone kept it out, if there is one.
  void remember(std::size_t option, const Margin& now) {
    using enum Margin::Outcome;
    std::optional<Margin>& margin = closest_[option];
    if (margin && margin->outcome != kOutbid) return;
    if (!margin || now.outcome != kOutbid ||
        closeness(now, problem_.goal.objective) > closeness(*margin, problem_.goal.objective))
      margin = now;
  }

  void take(const Bid& next) {
    const double gain = std::abs(next.lower);
    for (const std::size_t option : ways_.to(next.option)) {
      closest_[option] = {gain, gain, chosen_.size(), Margin::Outcome::kTaken};
      if (problem_.goal.exact_chosen || problem_.goal.wanted) problem_.refine_fully(option);
      chosen_.push_back(option);
      if (room_) room_->take(option);
      served_.add(problem_.coverage.bounds(option));
    }
  }

  const ChoiceProblem& problem_;
  StepMeasure measure_;
  std::vector<std::size_t>& chosen_;
  std::vector<std::optional<Margin>>& closest_;
  ServedBounds served_;
  Ways ways_;                 ///< from what is chosen
  std::optional<Room> room_;  ///< kLeast alone has one
  bool all_exact_ = true;
};

}  // namespace

void extend_greedily(const ChoiceProblem& problem, StepMeasure measure, std::vector<std::size_t>& chosen,
                     std::vector<std::optional<Margin>>& closest) {
  Greedy(problem, measure, chosen, closest).run();
}

}  // namespace itin::viewshed
