#include <algorithm>
#include <atomic>
#include <string>

#include <fmt/format.h>

#include <itin/parallel.hpp>

#include "siting/choice/choice_state.hpp"

namespace itin::viewshed {

namespace {

/// An exchange of the chosen site number `out` for option `in`. It betters the choice by `lower` to `upper`.
struct Exchange {
  std::size_t out = 0;
  std::size_t in = 0;
  Weight upper = 0;
  Weight lower = 0;

  friend bool operator<(const Exchange& a, const Exchange& b) {
    if (a.upper != b.upper) return a.upper > b.upper;
    return a.out != b.out ? a.out < b.out : a.in < b.in;
  }
};

std::vector<std::size_t> after(const Exchange& exchange, std::vector<std::size_t> chosen) {
  chosen[exchange.out] = exchange.in;
  return chosen;
}

/// Returns the exchanges that may gain, in order. `stage` names the search, which may take long, to the progress.
std::vector<Exchange> exchanges(const ChoiceProblem& problem, const std::vector<std::size_t>& chosen,
                                const std::string& stage) {
  const Served all = ServedBounds(problem, chosen).least;
  const bool least = problem.goal.objective == Objective::kLeast;
  std::vector<std::vector<Exchange>> of_site(chosen.size());
  std::atomic<std::size_t> done = 0;
  parallel_for(chosen.size(), [&](std::size_t s) {
    Served others = all;
    others.remove(problem.coverage.bounds(chosen[s]).certain);
    const Weight loss = others.completed_by(problem.coverage.bounds(chosen[s]).certain);
    std::vector<std::size_t> rest = chosen;
    rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(s));
    const double spent = problem.cost_of(rest);
    for (std::size_t option = 0; option < problem.options.size(); ++option) {
      if (option == chosen[s] || problem.is_barred(option) || problem.place_taken(option, rest) ||
          !problem.affordable(spent + problem.options[option].cost))
        continue;
      const CoverageBounds& bounds = problem.coverage.bounds(option);
      const Weight upper =
          least ? loss - others.completed_by(bounds.certain) : others.completed_by(bounds.possible) - loss;
      if (upper <= 0) continue;
      const Weight lower = bounds.exact ? upper
                           : least      ? loss - others.completed_by(bounds.possible)
                                        : others.completed_by(bounds.certain) - loss;
      of_site[s].push_back({s, option, upper, lower});
    }
    problem.progress.report(stage, static_cast<double>(++done) / static_cast<double>(chosen.size()));
  });
  std::vector<Exchange> result;
  for (const auto& some : of_site) result.insert(result.end(), some.begin(), some.end());
  std::sort(result.begin(), result.end());
  return result;
}

/// The best exchange, or nothing where none gains.
std::optional<Exchange> best_exchange(const ChoiceProblem& problem, const std::vector<std::size_t>& chosen,
                                      const std::string& stage) {
  for (;;) {
    problem.progress.throw_if_cancelled();
    std::vector<std::size_t> batch;
    Weight known = 0;
    for (const Exchange& exchange : exchanges(problem, chosen, stage)) {
      if (batch.size() >= problem.goal.batch || (!batch.empty() && exchange.upper < known)) break;
      if (std::find(batch.begin(), batch.end(), exchange.in) != batch.end()) continue;
      if (!problem.holds_together(after(exchange, chosen))) continue;
      if (problem.coverage.bounds(exchange.in).exact) {
        if (batch.empty()) return exchange;
      } else {
        batch.push_back(exchange.in);
      }
      known = std::max(known, exchange.lower);
    }
    if (batch.empty()) return std::nullopt;
    problem.coverage.refine(batch);
  }
}

}  // namespace

std::size_t swap(const ChoiceProblem& problem, std::vector<std::size_t>& chosen) {
  std::size_t count = 0;
  for (;; ++count) {
    const auto exchange = best_exchange(problem, chosen, fmt::format("search for exchange {}", count + 1));
    if (!exchange) return count;
    chosen = after(*exchange, chosen);
  }
}

void drop_needless(const ChoiceProblem& problem, std::vector<std::size_t>& chosen) {
  if (!problem.goal.wanted) return;
  const Weight existing = ServedBounds(problem, {}).least.value();
  for (;;) {
    std::optional<std::size_t> needless;
    Weight most = 0;
    for (std::size_t s = 0; s < chosen.size(); ++s) {
      std::vector<std::size_t> rest = chosen;
      rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(s));
      const Weight value = ServedBounds(problem, rest).least.value() - existing;
      if (value < *problem.goal.wanted || (needless && value <= most) || !problem.holds_together(rest)) continue;
      needless = s, most = value;
    }
    if (!needless) return;
    chosen.erase(chosen.begin() + static_cast<std::ptrdiff_t>(*needless));
  }
}

std::size_t drop_idle(const ChoiceProblem& problem, std::vector<std::size_t>& chosen) {
  if (!problem.goal.network) return 0;
  Served served = ServedBounds(problem, chosen).least;
  std::size_t count = 0;
  for (std::size_t s = chosen.size(); s-- > 0;) {
    const DemandSet& set = problem.coverage.bounds(chosen[s]).certain;
    std::vector<std::size_t> rest = chosen;
    rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(s));
    served.remove(set);
    if (served.gain(set) == 0 && problem.holds_together(rest)) {
      chosen = std::move(rest);
      s = chosen.size();  // those that linked it may be idle now
      ++count;
    } else {
      served.add(set);
    }
  }
  return count;
}

}  // namespace itin::viewshed
