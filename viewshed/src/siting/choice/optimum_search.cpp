#include <algorithm>
#include <cmath>
#include <queue>
#include <tuple>

#include "siting/choice/choice_state.hpp"
#include "siting/choice/greatest_gain.hpp"
#include "siting/choice/ways.hpp"

namespace itin::viewshed {

namespace {

/// How many words of coverage are looked at, over the whole search: a second or so.
constexpr double kWork = 3e8;
constexpr std::size_t kMostNodes = 5000;

/// Choices that hold some options and none of some others.
struct Node {
  Weight bound = 0;  ///< no such choice has a greater sum of min(served, cover)
  std::vector<std::size_t> in, out;
  std::size_t branch = 0;  ///< the option of the greatest gain, or the first on the way to it
  bool complete = false;   ///< nothing can be added

  friend bool operator<(const Node& a, const Node& b) {
    if (a.bound != b.bound) return a.bound < b.bound;
    return std::tie(a.in, a.out) < std::tie(b.in, b.out);
  }
};

class Search {
 public:
  explicit Search(const ChoiceProblem& problem) : problem_(problem), nothing_(problem.demand, problem.goal.cover) {
    for (const DemandSet& set : problem.goal.existing) {
      existing_ += nothing_.gain(set);
      nothing_.add(set);
    }
    double blocks = 0;
    for (std::size_t i = 0; i < problem.options.size(); ++i)
      blocks += static_cast<double>(problem.coverage.bounds(i).possible.blocks().size());
    double node = 2 * std::max(blocks, 1.0) + static_cast<double>(problem.demand.block_count()) * 40;
    if (problem.goal.network) node += std::pow(static_cast<double>(problem.goal.network->sites()), 2);
    most_nodes_ = std::min(kMostNodes, static_cast<std::size_t>(kWork / node));
  }

  /// Returns a bound on the sum of min(served, cover); `known` is the sum of a choice at hand.
  Weight run(std::size_t count, Weight known) {
    std::priority_queue<Node> open;
    open.push(evaluate({}, {}, count));
    for (std::size_t nodes = 0;; ++nodes) {
      problem_.progress.throw_if_cancelled();
      problem_.progress.report("bound on all choices",
                               static_cast<double>(nodes) / static_cast<double>(std::max<std::size_t>(1, most_nodes_)));
      const Node best = open.top();
      if (best.complete || best.bound <= known || nodes >= most_nodes_) return std::max(best.bound, known);
      open.pop();
      std::vector<std::size_t> in = best.in, out = best.out;
      in.push_back(best.branch);
      out.push_back(best.branch);
      open.push(evaluate(std::move(in), best.out, count));
      open.push(evaluate(best.in, std::move(out), count));
    }
  }

 private:
  Node evaluate(std::vector<std::size_t> in, std::vector<std::size_t> out, std::size_t count) const {
    Served served = nothing_;
    Weight sum = existing_;
    double spent = 0;
    for (const std::size_t option : in) {
      const DemandSet& set = problem_.coverage.bounds(option).possible;
      sum += served.gain(set);
      served.add(set);
      spent += problem_.options[option].cost;
    }
    ChoiceRules rules = problem_;
    rules.barred.resize(problem_.options.size());
    for (const std::size_t option : out) rules.barred[option] = true;
    const Extensions further = extensions(rules, in, count);
    const GreatestGain most = greatest_gain(problem_, served, further.open, count - in.size(), spent);
    return {.bound = sum + most.sum,
            .in = std::move(in),
            .out = std::move(out),
            .branch = further.first[most.best],
            .complete = most.sum == 0};
  }

  const ChoiceProblem& problem_;
  Served nothing_;  ///< only what existing sites serve
  Weight existing_ = 0;
  std::size_t most_nodes_ = 0;
};

}  // namespace

Weight search_optimum(const ChoiceProblem& problem, std::size_t count, Weight known) {
  return Search(problem).run(count, known);
}

}  // namespace itin::viewshed
