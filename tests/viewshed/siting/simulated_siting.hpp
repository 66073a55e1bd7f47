// Sites whose coverage is drawn at random, and bounds on it that close step by step.
#pragma once

#include <algorithm>
#include <map>
#include <random>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include <viewshed/siting.hpp>

namespace itin::test {

using viewshed::Choice, viewshed::ChosenSite, viewshed::Coverage, viewshed::CoverageBounds, viewshed::DemandSet,
    viewshed::SiteOption;

using Truth = std::vector<std::vector<bool>>;  ///< options by elements

inline DemandSet set_of(const std::vector<bool>& members) {
  DemandSet set;
  for (std::size_t first = 0; first < members.size(); first += 64) {
    std::uint64_t word = 0;
    for (std::size_t i = first; i < std::min(members.size(), first + 64); ++i)
      if (members[i]) word |= std::uint64_t{1} << (i - first);
    set.add(static_cast<std::uint32_t>(first / 64), word);
  }
  return set;
}

/// Bounds that close in three steps, at random.
class Simulated final : public Coverage {
 public:
  Simulated(const Truth& truth, double doubt, std::mt19937& random) : truth_(truth), bounds_(truth.size()) {
    std::bernoulli_distribution unsure(doubt);
    for (std::size_t i = 0; i < truth.size(); ++i) {
      std::vector<bool> certain = truth[i], possible = truth[i];
      for (std::size_t e = 0; e < truth[i].size(); ++e)
        if (unsure(random)) certain[e] = false, possible[e] = true;
      bounds_[i] = {set_of(certain), set_of(possible), false};
    }
  }
  const CoverageBounds& bounds(std::size_t option) const override { return bounds_[option]; }
  void refine(std::span<const std::size_t> options) override {
    for (const std::size_t option : options) {
      EXPECT_FALSE(bounds_[option].exact);
      const DemandSet exact = set_of(truth_[option]);
      if (++steps_[option] == 2) {
        bounds_[option] = {exact, exact, true};
      } else {
        // Half of the doubt goes.
        const std::size_t half = truth_[option].size() / 2;
        std::vector<bool> certain(truth_[option].size()), possible = certain;
        for (std::size_t e = 0; e < certain.size(); ++e) {
          certain[e] = e < half ? truth_[option][e] : bounds_[option].certain.contains(e);
          possible[e] = e < half ? truth_[option][e] : bounds_[option].possible.contains(e);
        }
        bounds_[option] = {set_of(certain), set_of(possible), false};
      }
      refined_.insert(option);
    }
  }
  std::size_t refined() const { return refined_.size(); }

 private:
  const Truth& truth_;
  std::vector<CoverageBounds> bounds_;
  std::map<std::size_t, int> steps_;
  std::set<std::size_t> refined_;
};

struct Instance {
  Truth truth;
  std::vector<double> weights;
  std::vector<SiteOption> options;

  Instance(std::size_t sites, std::size_t elements, std::size_t heights, std::mt19937& random) {
    std::uniform_real_distribution<double> share(0.02, 0.3);
    std::uniform_int_distribution<int> weight(0, 4), cost(1, 6);
    for (std::size_t e = 0; e < elements; ++e) weights.push_back(weight(random) * 0.25);
    for (std::size_t s = 0; s < sites; ++s) {
      std::vector<bool> sees(elements);
      for (std::size_t h = 0; h < heights; ++h) {
        std::bernoulli_distribution more(share(random));
        for (std::size_t e = 0; e < elements; ++e) sees[e] = sees[e] || more(random);
        truth.push_back(sees);
        options.push_back({s, static_cast<double>(cost(random))});
      }
    }
  }

  double sum(const std::vector<std::size_t>& chosen, int cover, bool capped) const {
    double result = 0;
    for (std::size_t e = 0; e < weights.size(); ++e) {
      int seen = 0;
      for (const std::size_t option : chosen) seen += truth[option][e];
      result += weights[e] * (capped ? std::min(seen, cover) : static_cast<int>(seen >= cover));
    }
    return result;
  }
  double cost(const std::vector<std::size_t>& chosen) const {
    double result = 0;
    for (const std::size_t option : chosen) result += options[option].cost;
    return result;
  }
  bool same_place(std::size_t option, const std::vector<std::size_t>& chosen) const {
    return std::any_of(chosen.begin(), chosen.end(),
                       [&](std::size_t other) { return options[other].place == options[option].place; });
  }
};

inline std::vector<std::size_t> options_of(const Choice& choice) {
  std::vector<std::size_t> result;
  for (const ChosenSite& site : choice.chosen) result.push_back(site.option);
  return result;
}

}  // namespace itin::test
