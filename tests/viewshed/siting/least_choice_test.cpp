// The choice that serves the least against every choice there is.
#include <algorithm>
#include <cmath>
#include <functional>
#include <gmock/gmock.h>
#include <iostream>
#include <limits>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

#include <itin/error.hpp>
#include <viewshed/siting.hpp>

#include "siting/choice/conflicts.hpp"
#include "siting/choice/least_search.hpp"
#include "siting/choice/payments.hpp"
#include "siting/choice/shared_demand.hpp"
#include "support/seed.hpp"
#include "viewshed/siting/simulated_siting.hpp"

namespace itin::viewshed {
namespace {

using test::Instance;
using test::options_of;
using test::Simulated;

/// Sites on a square, those nearer than `spacing` to each other apart. Sites that are neighbours serve much the same.
struct Field {
  Instance instance;
  std::vector<std::pair<double, double>> places;
  double spacing;

  Field(std::size_t sites, std::size_t elements, double spacing_, std::mt19937& random)
      : instance(sites, elements, 1, random), spacing(spacing_) {
    std::uniform_real_distribution<double> where(0, 1), reach(0.2, 0.6);
    std::bernoulli_distribution hidden(0.3);
    std::vector<std::pair<double, double>> of_element;
    for (std::size_t e = 0; e < elements; ++e) of_element.emplace_back(where(random), where(random));
    for (std::size_t s = 0; s < sites; ++s) {
      places.emplace_back(where(random), where(random));
      const double radius = reach(random);
      for (std::size_t e = 0; e < elements; ++e)
        instance.truth[s][e] = distance(places[s], of_element[e]) < radius && !hidden(random);
    }
  }

  static double distance(std::pair<double, double> a, std::pair<double, double> b) {
    return std::hypot(a.first - b.first, a.second - b.second);
  }
  bool apart(std::size_t a, std::size_t b) const { return distance(places[a], places[b]) >= spacing; }
  bool allowed(const std::vector<std::size_t>& chosen) const {
    for (std::size_t i = 0; i < chosen.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        if (!apart(chosen[i], chosen[j]) || instance.same_place(chosen[i], {chosen[j]})) return false;
    return true;
  }
  double served(const std::vector<std::size_t>& chosen, const std::vector<bool>& existing) const {
    double sum = 0;
    for (std::size_t e = 0; e < instance.weights.size(); ++e) {
      const bool seen = std::any_of(chosen.begin(), chosen.end(), [&](std::size_t o) { return instance.truth[o][e]; });
      if (seen && (existing.empty() || !existing[e])) sum += instance.weights[e];
    }
    return sum;
  }

  struct Best {
    double value = std::numeric_limits<double>::infinity();
    std::size_t most = 0;  ///< that fit together
  };
  /// By trying every set of `count` options.
  Best best_of_all(std::size_t count, const std::vector<bool>& existing) const {
    Best best;
    std::vector<std::size_t> chosen;
    const std::function<void(std::size_t)> extend = [&](std::size_t from) {
      best.most = std::max(best.most, chosen.size());
      if (chosen.size() == count) {
        best.value = std::min(best.value, served(chosen, existing));
        return;
      }
      for (std::size_t option = from; option < places.size(); ++option) {
        chosen.push_back(option);
        if (allowed(chosen)) extend(option + 1);
        chosen.pop_back();
      }
    };
    extend(0);
    return best;
  }
};

class LeastServed : public ::testing::Test {
 protected:
  LeastServed() { std::cout << "seed " << seed_ << '\n'; }

  ChoiceGoal goal_of(const Field& field, std::size_t count) const {
    ChoiceGoal goal{.objective = Objective::kLeast, .count = count};
    goal.compatible = [&field](std::size_t a, std::size_t b) { return field.apart(a, b); };
    return goal;
  }
  Choice choose_on_bounds(const Field& field, const ChoiceGoal& goal, double doubt) {
    Simulated coverage(field.instance.truth, doubt, random_);
    NoProgress progress;
    Choice choice = choose(Demand(field.instance.weights), field.instance.options, coverage, goal, progress);
    refined_ = coverage.refined();
    return choice;
  }
  static double metric(Weight weight) { return static_cast<double>(weight) * 0x1p-30; }

  std::uint32_t seed_ = test::seed();
  std::mt19937 random_{seed_};
  std::size_t refined_ = 0;
};

TEST_F(LeastServed, IsTheLeastOfAllChoicesOnSmallInstances) {
  for (int trial = 0; trial < 120; ++trial) {
    const Field field(14, 120, 0.05 * (trial % 4), random_);
    const std::size_t count = 1 + static_cast<std::size_t>(trial) % 5;
    ChoiceGoal goal = goal_of(field, count);
    std::vector<bool> existing;
    if (trial % 3 == 0) {
      existing = field.instance.truth[static_cast<std::size_t>(trial) % 14];
      goal.existing = {test::set_of(existing)};
    }
    const Field::Best best = field.best_of_all(count, existing);
    if (best.most < count) {
      NoProgress progress;
      EXPECT_THROW(choose_on_bounds(field, goal, 0), Error);
      continue;
    }
    const Choice choice = choose_on_bounds(field, goal, 0.1 * (trial % 5));
    const std::vector<std::size_t> chosen = options_of(choice);
    ASSERT_EQ(chosen.size(), count);
    ASSERT_TRUE(field.allowed(chosen));
    ASSERT_DOUBLE_EQ(metric(choice.value), field.served(chosen, existing));
    ASSERT_DOUBLE_EQ(metric(choice.value), best.value) << "trial " << trial;
    ASSERT_EQ(choice.lower_bound, choice.value) << "trial " << trial;
    ASSERT_EQ(gap_percent(choice), 0);
    double sum = 0;
    for (const ChosenSite& site : choice.chosen) {
      sum += metric(site.gain);
      ASSERT_DOUBLE_EQ(metric(site.cumulative), sum);
    }
  }
}

/// Visible heights add: every option serves what no other does.
TEST_F(LeastServed, IsTheLeastWhereNothingIsShared) {
  std::uniform_real_distribution<double> weight(0, 50);
  for (int trial = 0; trial < 60; ++trial) {
    Field field(14, 14, 0.1 + 0.05 * (trial % 4), random_);
    for (std::size_t s = 0; s < 14; ++s) {
      field.instance.weights[s] = std::floor(weight(random_) * 4) / 4;
      for (std::size_t e = 0; e < 14; ++e) field.instance.truth[s][e] = s == e;
    }
    const std::size_t count = 1 + static_cast<std::size_t>(trial) % 4;
    const Field::Best best = field.best_of_all(count, {});
    if (best.most < count) continue;
    const Choice choice = choose_on_bounds(field, goal_of(field, count), 0);
    ASSERT_DOUBLE_EQ(metric(choice.value), best.value) << "trial " << trial;
    ASSERT_EQ(choice.lower_bound, choice.value);
  }
}

TEST_F(LeastServed, HasABoundThatNoChoicePassesHoweverLittleIsSearched) {
  for (int trial = 0; trial < 60; ++trial) {
    const Field field(14, 150, 0.1, random_);
    const std::size_t count = 2 + static_cast<std::size_t>(trial) % 3;
    const Field::Best best = field.best_of_all(count, {});
    if (best.most < count) continue;
    const Demand demand(field.instance.weights);
    Simulated coverage(field.instance.truth, 0, random_);
    NoProgress progress;
    ChoiceGoal goal = goal_of(field, count);
    const ChoiceRules rules{field.instance.options, goal, {}};
    const Conflicts conflicts(rules, count);
    const ChoiceProblem problem{rules, demand, coverage, progress, &conflicts};
    const SharedDemand shared = shared_demand(problem, std::vector<bool>(14, true));
    std::vector<std::size_t> all(14);
    std::iota(all.begin(), all.end(), std::size_t{0});
    for (const double work : {0.0, 1e3, 1e5}) {
      const LeastAnswer answer =
          search_least({conflicts, shared, all, count, std::numeric_limits<Weight>::max()}, work, progress);
      ASSERT_LE(metric(answer.bound), best.value) << "trial " << trial << ", work " << work;
      ASSERT_GE(answer.bound, 0);
      if (!answer.better) continue;
      ASSERT_EQ(answer.better->size(), count);
      ASSERT_TRUE(field.allowed(*answer.better));
      ASSERT_GE(field.served(*answer.better, {}), best.value);
    }
  }
}

TEST_F(LeastServed, PaysForNoElementMoreThanItsWeight) {
  std::uniform_real_distribution<double> share(0.01, 4);
  std::uniform_int_distribution<std::size_t> any(0, 13);
  for (int trial = 0; trial < 60; ++trial) {
    const Field field(14, 150, 0, random_);
    const Demand demand(field.instance.weights);
    Simulated coverage(field.instance.truth, 0, random_);
    NoProgress progress;
    ChoiceGoal goal = goal_of(field, 4);
    const ChoiceProblem problem{{field.instance.options, goal, {}}, demand, coverage, progress, nullptr};
    const SharedDemand shared = shared_demand(problem, std::vector<bool>(14, true));
    Payments payments(shared);
    OpenChoice choice{{any(random_)}, {}, std::vector<double>(14)};
    for (std::size_t o = 0; o < 14; ++o) {
      choice.shares[o] = share(random_);
      if (o != choice.chosen.front()) choice.open.push_back(o);
    }
    const double chosen = field.served(choice.chosen, {});
    ASSERT_DOUBLE_EQ(metric(payments.serve(choice.chosen)), chosen);
    const std::vector<double> paid = payments.of(choice, 3);
    for (int draw = 0; draw < 30; ++draw) {
      std::vector<std::size_t> places(choice.open.size());
      std::iota(places.begin(), places.end(), std::size_t{0});
      std::shuffle(places.begin(), places.end(), random_);
      std::vector<std::size_t> whole = choice.chosen;
      double sum = 0;
      for (std::size_t i = 0; i < 3; ++i) whole.push_back(choice.open[places[i]]), sum += paid[places[i]];
      ASSERT_LE(sum * 0x1p-30, (field.served(whole, {}) - chosen) * (1 + 1e-9));
    }
  }
}

TEST_F(LeastServed, IsTheSameInWhateverOrderCandidatesCome) {
  for (int trial = 0; trial < 20; ++trial) {
    const Field field(24, 200, 0.12, random_);
    const Choice first = choose_on_bounds(field, goal_of(field, 4), 0.1);
    Field shuffled = field;
    std::vector<std::size_t> order(24);
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::shuffle(order.begin(), order.end(), random_);
    for (std::size_t i = 0; i < order.size(); ++i) {
      shuffled.places[i] = field.places[order[i]];
      shuffled.instance.truth[i] = field.instance.truth[order[i]];
    }
    const Choice second = choose_on_bounds(shuffled, goal_of(shuffled, 4), 0.3);
    ASSERT_EQ(first.value, second.value);
    ASSERT_EQ(first.lower_bound, second.lower_bound);
    // Equal choices apart, they are the same places.
    std::vector<std::size_t> places;
    for (const std::size_t option : options_of(second)) places.push_back(order[option]);
    ASSERT_DOUBLE_EQ(field.served(places, {}), metric(first.value));
  }
}

TEST_F(LeastServed, RefusesWhatDoesNotFitTogetherAndSaysHowManyDo) {
  std::size_t refused = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const Field field(12, 20, 0.3 + 0.1 * (trial % 3), random_);
    const std::size_t most = field.best_of_all(13, {}).most;
    const ChoiceGoal goal = goal_of(field, most + 1);
    try {
      choose_on_bounds(field, goal, 0);
      FAIL() << most << " fit";
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr(std::to_string(most) + " of 12 sites can be chosen together"));
      ++refused;
    }
    EXPECT_EQ(choose_on_bounds(field, goal_of(field, most), 0).chosen.size(), most);
  }
  EXPECT_EQ(refused, 60U);
}

TEST_F(LeastServed, LooksAgainOnlyAtThoseThatMayBeAmongThem) {
  std::size_t looked_at = 0;
  for (int trial = 0; trial < 10; ++trial) {
    const Field field(60, 900, 0.05, random_);
    choose_on_bounds(field, goal_of(field, 5), 0.02);
    looked_at += refined_;
  }
  std::cout << looked_at << " of 600 options were refined\n";
  EXPECT_LT(looked_at, 300U);
}

TEST_F(LeastServed, TakesACountAndNothingElse) {
  const Field field(6, 20, 0, random_);
  for (const auto change : std::initializer_list<void (*)(ChoiceGoal&)>{
           [](ChoiceGoal& g) { g.count.reset(), g.budget = 3; }, [](ChoiceGoal& g) { g.budget = 3; },
           [](ChoiceGoal& g) { g.wanted = 1; }, [](ChoiceGoal& g) { g.cover = 2; },
           [](ChoiceGoal& g) { g.exact_chosen = false; }}) {
    ChoiceGoal goal = goal_of(field, 2);
    change(goal);
    EXPECT_THROW(choose_on_bounds(field, goal, 0), InputError);
  }
}

/// Too many for every choice to be tried.
TEST_F(LeastServed, IsWithinItsBoundAmongMany) {
  double sum = 0, bound = 0;
  for (int trial = 0; trial < 6; ++trial) {
    const Field field(60, 900, 0.08, random_);
    const Choice choice = choose_on_bounds(field, goal_of(field, 8), 0);
    EXPECT_LE(choice.lower_bound, choice.value);
    EXPECT_TRUE(field.allowed(options_of(choice)));
    sum += metric(choice.value), bound += metric(choice.lower_bound);
  }
  std::cout << "served " << sum << ", at least " << bound << '\n';
  EXPECT_GT(bound, 0.5 * sum);
}

}  // namespace
}  // namespace itin::viewshed
