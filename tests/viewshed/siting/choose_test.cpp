// The choice on bounds against greedy, swaps and the optimum of exact coverage, done the slow way.
#include <algorithm>
#include <iostream>
#include <random>

#include <gtest/gtest.h>

#include <itin/error.hpp>
#include <viewshed/siting.hpp>

#include "support/seed.hpp"
#include "support/told_progress.hpp"
#include "viewshed/siting/simulated_siting.hpp"

namespace itin::viewshed {
namespace {

using test::Instance;
using test::options_of;
using test::set_of;
using test::Simulated;
using test::Truth;

bool all_pairs(const std::vector<std::size_t>& chosen, const auto& compatible) {
  for (const std::size_t a : chosen)
    for (const std::size_t b : chosen)
      if (a < b && !compatible(a, b)) return false;
  return true;
}

bool within(const Instance& instance, const ChoiceGoal& goal, const std::vector<std::size_t>& chosen) {
  return (!goal.count || chosen.size() <= *goal.count) && (!goal.budget || instance.cost(chosen) <= *goal.budget) &&
         (!goal.compatible || all_pairs(chosen, goal.compatible));
}

std::vector<std::size_t> slow_greedy(const Instance& instance, const ChoiceGoal& goal, bool per_cost) {
  std::vector<std::size_t> chosen;
  for (;;) {
    double best = 0;
    std::optional<std::size_t> taken;
    for (std::size_t option = 0; option < instance.options.size(); ++option) {
      std::vector<std::size_t> more = chosen;
      more.push_back(option);
      if (instance.same_place(option, chosen) || !within(instance, goal, more)) continue;
      const double gain = (instance.sum(more, goal.cover, true) - instance.sum(chosen, goal.cover, true)) /
                          (per_cost ? instance.options[option].cost : 1);
      if (gain > best) best = gain, taken = option;
    }
    if (!taken) return chosen;
    chosen.push_back(*taken);
    if (goal.wanted && instance.sum(chosen, goal.cover, false) * 4 >= static_cast<double>(*goal.wanted)) return chosen;
  }
}

/// Far less than any weight.
constexpr double kRounding = 1e-9;

void slow_swaps(const Instance& instance, const ChoiceGoal& goal, std::vector<std::size_t>& chosen) {
  for (;;) {
    double best = 0;
    std::vector<std::size_t> taken;
    for (std::size_t s = 0; s < chosen.size(); ++s) {
      for (std::size_t option = 0; option < instance.options.size(); ++option) {
        std::vector<std::size_t> other = chosen;
        other.erase(other.begin() + static_cast<std::ptrdiff_t>(s));
        if (option == chosen[s] || instance.same_place(option, other)) continue;
        other.insert(other.begin() + static_cast<std::ptrdiff_t>(s), option);
        if (!within(instance, goal, other)) continue;
        const double gain = instance.sum(other, goal.cover, false) - instance.sum(chosen, goal.cover, false);
        if (gain > best + kRounding) best = gain, taken = other;
      }
    }
    if (best == 0) return;
    chosen = taken;
  }
}

std::vector<std::size_t> sorted(std::vector<std::size_t> v) {
  std::sort(v.begin(), v.end());
  return v;
}

/// By trying every set.
double optimum(const Instance& instance, const ChoiceGoal& goal, std::vector<std::size_t>& chosen, std::size_t from) {
  double best = instance.sum(chosen, goal.cover, false);
  for (std::size_t option = from; option < instance.options.size(); ++option) {
    if (instance.same_place(option, chosen)) continue;
    chosen.push_back(option);
    if (within(instance, goal, chosen)) best = std::max(best, optimum(instance, goal, chosen, option + 1));
    chosen.pop_back();
  }
  return best;
}

class Choosing : public ::testing::Test {
 protected:
  Choosing() { std::cout << "seed " << seed_ << '\n'; }
  Choice choose_on_bounds(const Instance& instance, const ChoiceGoal& goal, double doubt) {
    Simulated coverage(instance.truth, doubt, random_);
    NoProgress progress;
    Choice choice = choose(Demand(instance.weights), instance.options, coverage, goal, progress);
    refined_ = coverage.refined();
    return choice;
  }
  std::uint32_t seed_ = test::seed();
  std::mt19937 random_{seed_};
  std::size_t refined_ = 0;
};

TEST_F(Choosing, GreedyIsThatOfExactCoverage) {
  for (int trial = 0; trial < 150; ++trial) {
    const Instance instance(30, 150, 1 + trial % 2, random_);
    ChoiceGoal goal{.count = 6};
    goal.cover = 1 + trial % 3;
    goal.swaps = false;
    goal.batch = 1 + static_cast<std::size_t>(trial) % 5;
    const Choice choice = choose_on_bounds(instance, goal, 0.1 * (trial % 5));
    ASSERT_EQ(options_of(choice), slow_greedy(instance, goal, false)) << "trial " << trial;
    ASSERT_DOUBLE_EQ(static_cast<double>(choice.value) * 0x1p-30, instance.sum(options_of(choice), goal.cover, false));
  }
}

TEST_F(Choosing, OpenBoundsOfChosenSitesChangeNoChoice) {
  for (int trial = 0; trial < 60; ++trial) {
    const Instance instance(25, 120, 1, random_);
    ChoiceGoal goal{.count = 5};
    goal.exact_chosen = false;
    const Choice choice = choose_on_bounds(instance, goal, 0.02 * (trial % 4));
    ASSERT_EQ(options_of(choice), slow_greedy(instance, goal, false));
    ASSERT_LE(static_cast<double>(choice.value) * 0x1p-30, instance.sum(options_of(choice), 1, false));
  }
}

TEST_F(Choosing, SwapsAreThoseOfExactCoverage) {
  int swapped = 0;
  for (int trial = 0; trial < 100; ++trial) {
    const Instance instance(25, 100, 1, random_);
    ChoiceGoal goal{.count = 5};
    goal.cover = 1 + trial % 3;
    const Choice choice = choose_on_bounds(instance, goal, 0.1 * (trial % 4));
    std::vector<std::size_t> slow = slow_greedy(instance, goal, false);
    slow_swaps(instance, goal, slow);
    ASSERT_EQ(sorted(options_of(choice)), sorted(slow)) << "trial " << trial;
    swapped += goal.cover > 1 && choice.swaps > 0;
  }
  EXPECT_GT(swapped, 0);
}

TEST_F(Choosing, TheSearchesAfterTheFirstSelectionAreReported) {
  const Instance instance(40, 150, 1, random_);
  const ChoiceGoal goal{.count = 6};
  Simulated coverage(instance.truth, 0, random_);
  test::ToldProgress told;
  choose(Demand(instance.weights), instance.options, coverage, goal, told);
  for (const char* stage : {"choice", "search for exchange 1", "bound on all choices"})
    EXPECT_FALSE(told.of(stage).empty()) << stage;
}

TEST_F(Choosing, NoChoiceIsBetterThanTheBound) {
  for (int trial = 0; trial < 60; ++trial) {
    const Instance instance(8, 60, 1 + trial % 2, random_);
    ChoiceGoal goal;
    if (trial % 3 != 1) goal.count = 3;
    if (trial % 3 != 0) goal.budget = 8;
    goal.cover = 1 + trial % 2;
    const Choice choice = choose_on_bounds(instance, goal, 0.2);
    std::vector<std::size_t> none;
    const double best = optimum(instance, goal, none, 0), bound = static_cast<double>(choice.upper_bound) * 0x1p-30;
    EXPECT_LE(best, bound + 1e-9) << "trial " << trial;
    EXPECT_LE(static_cast<double>(choice.value) * 0x1p-30, best + 1e-9);
    EXPECT_LE(instance.cost(options_of(choice)), goal.budget.value_or(1e9));
    EXPECT_LE(choice.chosen.size(), goal.count.value_or(100));
  }
}

TEST_F(Choosing, OfSmallCasesTheOptimumIsFound) {
  for (int trial = 0; trial < 40; ++trial) {
    const Instance instance(9, 80, 1 + trial % 2, random_);
    ChoiceGoal goal;
    if (trial % 3 != 1) goal.count = 3;
    if (trial % 3 != 0) goal.budget = 8;
    const double doubt = goal.count ? 0.1 * (trial % 4) : 0;  // without a count bounds may stay open
    const Choice choice = choose_on_bounds(instance, goal, doubt);
    std::vector<std::size_t> none;
    const double best = optimum(instance, goal, none, 0), value = static_cast<double>(choice.value) * 0x1p-30;
    if (goal.count) {
      EXPECT_NEAR(value, best, 1e-6) << "trial " << trial;
    }
    // Equal weights apart, the bound is the optimum; the knapsack's fractions may round it up by one unit.
    EXPECT_NEAR(static_cast<double>(choice.upper_bound) * 0x1p-30, std::max(best, value), 1e-6) << "trial " << trial;
  }
}

TEST_F(Choosing, OfThousandsOfChoicesOfExactOptionsTheOptimumIsFound) {
  std::size_t improved = 0;
  for (int trial = 0; trial < 30; ++trial) {
    const Instance instance(26, 60, 1, random_);
    ChoiceGoal goal{.count = 3};
    goal.cover = 1 + trial % 2;
    Simulated coverage(instance.truth, 0, random_);
    for (std::size_t i = 0; i < instance.options.size(); ++i)
      while (!coverage.bounds(i).exact) coverage.refine({&i, 1});
    NoProgress progress;
    const Choice choice = choose(Demand(instance.weights), instance.options, coverage, goal, progress);
    std::vector<std::size_t> none, swapped = slow_greedy(instance, goal, false);
    slow_swaps(instance, goal, swapped);
    const double best = optimum(instance, goal, none, 0);
    EXPECT_NEAR(static_cast<double>(choice.value) * 0x1p-30, best, kRounding) << "trial " << trial;
    EXPECT_EQ(choice.upper_bound, choice.value);
    improved += best > instance.sum(swapped, goal.cover, false) + kRounding;
  }
  EXPECT_GT(improved, 0U);
}

TEST_F(Choosing, NoChoiceOfAWantedShareCostsLessThanTheBound) {
  std::size_t tight = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const Instance instance(11, 40, 1, random_);
    Simulated coverage(instance.truth, 0.1 * (trial % 3), random_);
    ChoiceGoal goal;
    goal.cover = 1 + trial % 2;
    double all = 0;
    for (const double weight : instance.weights) all += weight;
    goal.wanted = static_cast<Weight>(all * 0.4 * 0x1p30);
    NoProgress progress;
    const Choice choice = choose(Demand(instance.weights), instance.options, coverage, goal, progress);
    EXPECT_DOUBLE_EQ(choice.cost, instance.cost(options_of(choice)));
    ASSERT_EQ(choice.least_cost.has_value(), choice.value >= *goal.wanted);
    if (!choice.least_cost) continue;
    double cheapest = choice.cost;
    for (unsigned set = 0; set < 1U << instance.options.size(); ++set) {
      std::vector<std::size_t> chosen;
      for (std::size_t i = 0; i < instance.options.size(); ++i)
        if ((set >> i & 1) != 0) chosen.push_back(i);
      if (instance.sum(chosen, goal.cover, false) * 0x1p30 >= static_cast<double>(*goal.wanted))
        cheapest = std::min(cheapest, instance.cost(chosen));
    }
    EXPECT_LE(*choice.least_cost, cheapest * (1 + 1e-9)) << "trial " << trial;
    EXPECT_GT(*choice.least_cost, 0);
    tight += *choice.least_cost > 0.6 * cheapest;
  }
  EXPECT_GT(tight, 10U);
}

TEST_F(Choosing, ABudgetIsSpentAsOnExactCoverage) {
  for (int trial = 0; trial < 60; ++trial) {
    const Instance instance(20, 100, 2, random_);
    ChoiceGoal goal{.budget = 11};
    goal.swaps = false;
    const Choice choice = choose_on_bounds(instance, goal, 0.1 * (trial % 4));
    const auto by_cost = slow_greedy(instance, goal, true), by_gain = slow_greedy(instance, goal, false);
    const double best = std::max(instance.sum(by_cost, 1, false), instance.sum(by_gain, 1, false));
    ASSERT_DOUBLE_EQ(static_cast<double>(choice.value) * 0x1p-30, best);
  }
}

TEST_F(Choosing, AWantedShareEndsTheChoiceAndLeavesNothingNeedless) {
  for (int trial = 0; trial < 40; ++trial) {
    const Instance instance(30, 100, 1, random_);
    const Demand demand(instance.weights);
    ChoiceGoal goal;
    goal.wanted = demand.total() / 2;
    const Choice choice = choose_on_bounds(instance, goal, 0.2);
    ASSERT_GE(choice.value, *goal.wanted);
    for (std::size_t s = 0; s < choice.chosen.size(); ++s) {
      std::vector<std::size_t> rest = options_of(choice);
      rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(s));
      EXPECT_LT(instance.sum(rest, 1, false), static_cast<double>(*goal.wanted) * 0x1p-30);
    }
  }
}

TEST_F(Choosing, NoTwoThatExcludeEachOtherAreChosen) {
  for (int trial = 0; trial < 40; ++trial) {
    const Instance instance(30, 100, 1, random_);
    ChoiceGoal goal{.count = 5};
    goal.swaps = false;
    goal.compatible = [](std::size_t a, std::size_t b) { return (a ^ b) % 8 != 0; };
    const Choice choice = choose_on_bounds(instance, goal, 0.3);
    ASSERT_EQ(options_of(choice), slow_greedy(instance, goal, false));
    goal.swaps = true;
    const std::vector<std::size_t> swapped = options_of(choose_on_bounds(instance, goal, 0.3));
    EXPECT_TRUE(all_pairs(swapped, goal.compatible));
  }
}

TEST_F(Choosing, WhatExistingSitesServeIsNoGain) {
  const Instance instance(10, 100, 1, random_);
  ChoiceGoal goal{.count = 1};
  goal.existing = {set_of(instance.truth[0]), set_of(instance.truth[1])};
  const Choice choice = choose_on_bounds(instance, goal, 0.1);
  ASSERT_EQ(choice.chosen.size(), 1U);
  EXPECT_GT(choice.chosen[0].option, 1U);
  const std::vector<std::size_t> all{0, 1, choice.chosen[0].option};
  EXPECT_DOUBLE_EQ(static_cast<double>(choice.value) * 0x1p-30,
                   instance.sum(all, 1, false) - instance.sum({0, 1}, 1, false));
}

TEST_F(Choosing, FewOptionsAreRefinedWhereBoundsAreTight) {
  const Instance instance(200, 400, 1, random_);
  ChoiceGoal goal{.count = 4};
  goal.batch = 1;
  goal.swaps = false;
  choose_on_bounds(instance, goal, 0.01);
  EXPECT_LT(refined_, 60U);
}

TEST(Choose, AGoalMustHaveAnEnd) {
  const Truth truth{{true}};
  std::mt19937 random(1);
  Simulated coverage(truth, 0, random);
  NoProgress progress;
  EXPECT_THROW(choose(Demand(1), {{0, 1}}, coverage, {}, progress), InputError);
}

TEST(Demand, WeightsAreWholeNumbersOfAUnit) {
  EXPECT_EQ(Demand(std::vector<double>{1, 2, 3}).total(), 6);
  EXPECT_EQ(Demand(70).total(), 70);
  const Demand halves(std::vector<double>{0.5, 0.25, 1e6});
  EXPECT_DOUBLE_EQ(halves.in_metric(halves.total()), 1000000.75);
  EXPECT_EQ(halves.at_least(0.5), halves.weight(0, 1));
  EXPECT_THROW(Demand(std::vector<double>{-1}), InputError);
  EXPECT_THROW(Demand(std::vector<double>{std::nan("")}), InputError);
}

}  // namespace
}  // namespace itin::viewshed
