#include "siting/choice/least_search.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <queue>
#include <utility>

#include "siting/choice/payments.hpp"

namespace itin::viewshed {

namespace {

constexpr std::size_t kMostLeastNodes = 5000;
/// How often shares are raised, and by how much: chosen by trial on simulated viewsheds.
constexpr int kRootRounds = 40, kRounds = 5;
constexpr double kRaise = 1.3;
/// A greatest share far beyond what shares differ by, and far below what a double holds.
constexpr double kGreatestShare = 1e100;

/// The least whole weight that is not below a sum of payments, whatever its rounding.
Weight at_least(double payments) {
  return static_cast<Weight>(std::ceil(payments * (1 - 1e-9)));
}

struct LeastNode {
  OpenChoice choice;
  Weight bound = 0;
  std::size_t number = 0;  ///< in the order in which they were made
  std::size_t branch = 0;

  friend bool operator<(const LeastNode& a, const LeastNode& b) {
    return a.bound != b.bound ? a.bound > b.bound : a.number > b.number;
  }
};

/// The open options that cost least, at most one per group.
template <class Cost>
struct Cheapest {
  std::vector<std::size_t> taken;  ///< places among the open options, the cheapest first
  Cost sum = 0;
  Cost last = 0;  ///< what the dearest one taken costs
};

template <class Cost>
Cheapest<Cost> cheapest(const Conflicts& conflicts, const std::vector<std::size_t>& open,
                        const std::vector<Cost>& costs, std::size_t count) {
  std::vector<std::size_t> order(open.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return costs[a] < costs[b]; });
  std::vector<bool> met(conflicts.size());
  Cheapest<Cost> result;
  for (const std::size_t place : order) {
    if (result.taken.size() == count) break;
    const std::size_t group = conflicts.groups()[open[place]];
    if (met[group]) continue;
    met[group] = true;
    result.taken.push_back(place);
    result.sum += costs[place], result.last = costs[place];
  }
  return result;
}

class LeastSearch {
 public:
  LeastSearch(const LeastQuestion& question, double work, Progress& progress)
      : question_(question),
        payments_(question.demand),
        most_work_(work),
        progress_(progress),
        known_(question.known) {}

  LeastAnswer run() && {
    std::priority_queue<LeastNode> open;
    const auto add = [&](OpenChoice choice, Weight bound) {
      LeastNode node{.choice = std::move(choice), .bound = bound, .number = ++nodes_};
      if (evaluate(node)) open.push(std::move(node));
    };
    add({{}, question_.open, std::vector<double>(question_.conflicts.size(), 1)}, 0);
    while (!open.empty() && open.top().bound < known_ && nodes_ < kMostLeastNodes && payments_.work() < most_work_) {
      progress_.throw_if_cancelled();
      progress_.report("bound on all choices", payments_.work() / most_work_);
      const LeastNode node = open.top();
      open.pop();
      OpenChoice with = node.choice, without = node.choice;
      with.chosen.push_back(node.branch);
      std::erase_if(with.open,
                    [&](std::size_t o) { return o == node.branch || question_.conflicts.between(node.branch, o); });
      std::erase(without.open, node.branch);
      add(std::move(with), node.bound);
      add(std::move(without), node.bound);
    }
    const Weight bound = open.empty() ? known_ : std::min(known_, open.top().bound);
    return {.bound = bound, .better = std::move(best_), .work = payments_.work()};
  }

 private:
  /// Bounds what the choices of the node serve, and finds where to branch. Returns whether a choice better than what is
  /// known may be among them.
  bool evaluate(LeastNode& node) {
    OpenChoice& choice = node.choice;
    const std::size_t missing = question_.count - choice.chosen.size();
    const int rounds = nodes_ == 1 ? kRootRounds : kRounds;
    for (int round = 0; round < rounds; ++round) {
      const Weight served = payments_.serve(choice.chosen);
      const std::vector<Weight> gains = gains_of(choice, known_ - served);
      const auto by_gain = cheapest(question_.conflicts, choice.open, gains, missing);
      if (by_gain.taken.size() < missing) return false;
      const std::vector<double> payments = payments_.of(choice, missing);
      const auto by_payment = cheapest(question_.conflicts, choice.open, payments, missing);
      // All that is missing serves at least as much as the greatest part of it.
      node.bound = std::max({node.bound, served + by_gain.last, served + at_least(by_payment.sum)});
      offer(choice, by_gain.taken);
      offer(choice, by_payment.taken);
      if (node.bound >= known_) return false;
      node.branch = choice.open[most_wrong(choice, by_payment.taken, gains, payments)];
      for (const std::size_t place : by_payment.taken) {
        double& share = choice.shares[choice.open[place]];
        share = std::min(kRaise * share, kGreatestShare);
      }
      const double others = by_payment.sum - by_payment.last;
      leave_out(choice, [&](std::size_t place) { return served + at_least(payments[place] + others) >= known_; });
      if (payments_.work() >= most_work_) break;
    }
    return true;
  }

  template <class Unfit>
  static void leave_out(OpenChoice& choice, const Unfit& unfit) {
    std::vector<std::size_t> rest;
    for (std::size_t place = 0; place < choice.open.size(); ++place)
      if (!unfit(place)) rest.push_back(choice.open[place]);
    choice.open = std::move(rest);
  }

  /// Returns what the open options serve, after leaving out those that serve as much as the limit by themselves.
  std::vector<Weight> gains_of(OpenChoice& choice, Weight limit) {
    std::vector<Weight> gains;
    for (const std::size_t option : choice.open) gains.push_back(payments_.gain(option));
    leave_out(choice, [&](std::size_t place) { return gains[place] >= limit; });
    std::erase_if(gains, [&](Weight gain) { return gain >= limit; });
    return gains;
  }

  /// Keeps the choice with these open options if it is allowed, and the best so far.
  void offer(const OpenChoice& choice, const std::vector<std::size_t>& taken) {
    std::vector<std::size_t> whole = choice.chosen;
    for (const std::size_t place : taken) {
      const auto excluded = [&](std::size_t other) { return question_.conflicts.between(choice.open[place], other); };
      if (std::any_of(whole.begin(), whole.end(), excluded)) return;
      whole.push_back(choice.open[place]);
    }
    const Weight served = payments_.serve(whole);
    payments_.serve(choice.chosen);
    if (served < known_) known_ = served, best_ = std::move(whole);
  }

  /// The place of the option taken that excludes the most of the others; among equals, of the one that serves most
  /// beyond what it pays.
  std::size_t most_wrong(const OpenChoice& choice, const std::vector<std::size_t>& taken,
                         const std::vector<Weight>& gains, const std::vector<double>& payments) const {
    const auto wrong = [&](std::size_t place) {
      const auto excluded = std::count_if(taken.begin(), taken.end(), [&](std::size_t other) {
        return question_.conflicts.between(choice.open[place], choice.open[other]);
      });
      return std::pair(excluded, static_cast<double>(gains[place]) - payments[place]);
    };
    return *std::max_element(taken.begin(), taken.end(),
                             [&](std::size_t a, std::size_t b) { return wrong(a) < wrong(b); });
  }

  const LeastQuestion& question_;
  Payments payments_;
  double most_work_;
  Progress& progress_;
  Weight known_;
  std::optional<std::vector<std::size_t>> best_;
  std::size_t nodes_ = 0;
};

}  // namespace

LeastAnswer search_least(const LeastQuestion& question, double work, Progress& progress) {
  return LeastSearch(question, work, progress).run();
}

}  // namespace itin::viewshed
