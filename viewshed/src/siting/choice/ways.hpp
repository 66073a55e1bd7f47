// How options can join a choice: by themselves, or over a network together with the relays that link them with it.
#pragma once

#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "siting/choice/choice_state.hpp"

namespace itin::viewshed {

/// How an option is linked with a choice: by itself, or by others that must be added before it.
struct Way {
  std::optional<std::size_t> before{};  ///< the option before it; none: it is linked with the choice
  std::size_t sites = 0;                ///< number of options on the way, itself included
  double cost = 0;                      ///< what these cost together
};

/// The ways to the options that can be added.
class Ways {
 public:
  explicit Ways(std::vector<std::optional<Way>> ways) : ways_(std::move(ways)) {}
  const std::optional<Way>& operator[](std::size_t option) const { return ways_[option]; }
  /// The options on the way to an option, from the choice on. Precondition: there is a way.
  std::vector<std::size_t> to(std::size_t option) const;

 private:
  std::vector<std::optional<Way>> ways_;
};

struct WayRules {
  std::size_t most_sites = 0;  ///< the choice and the way together have no more
  bool by_cost = false;        ///< the cheapest way, otherwise the one of fewest options
  /// Whether the ways are for bounds. If so, they lead to every option that any allowed choice may hold besides the
  /// given one. They keep within the budget if they are by cost, otherwise within the number of sites, and may hold
  /// options that exclude each other.
  bool relaxed = false;
};

/// Finds ways from a connected choice, over options that are not barred. Where the choice is empty, ways begin at the
/// hub; without a hub any option may begin. Options that `compatible` forbids are left out only where there is a
/// network.
Ways ways_to_options(const ChoiceRules& rules, std::span<const std::size_t> chosen, const WayRules& way);

/// What choices of at most `count` sites may hold if they hold all of `chosen`.
struct Extensions {
  std::vector<bool> open;
  std::vector<std::size_t> first;  ///< for each open option what a way to it begins with
};
Extensions extensions(const ChoiceRules& rules, std::span<const std::size_t> chosen, std::size_t count);

/// Returns the options that links may ever join in one choice: a set for each connected part. Where there is no
/// network, or a hub, it is one set of all.
std::vector<std::vector<bool>> separate_parts(const ChoiceRules& rules);

}  // namespace itin::viewshed
