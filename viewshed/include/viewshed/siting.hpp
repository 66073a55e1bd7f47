// Chooses the few of many sites that serve the most. Bounds on what each serves suffice for the exact choice.
//
//   // `coverage` is a SiteCoverage, or any other Coverage of these options.
//   const viewshed::Demand demand(viewshed::element_count(grid));
//   const std::vector<viewshed::SiteOption> options = {{.place = 0}, {.place = 1}, {.place = 2}};
//   const viewshed::Choice choice = viewshed::choose(demand, options, coverage, {.count = 2}, progress);
//   for (const viewshed::ChosenSite& site : choice.chosen) std::cout << site.option << ' ' << site.gain << '\n';
//
// Coverage comes with two sets for each option: what it certainly serves, and what it may serve. Lazy greedy (Minoux
// 1978) takes the option of the greatest upper bound; where its bounds leave open whether it is the best, it is refined
// and judged again. An option whose upper bound never comes first is never refined. Still the choice is the one that
// greedy makes on exact coverage, ties falling to the option that comes first. Swaps of one chosen site for another
// follow, under the same rule, until none gains. Where a count allows no more than a thousand choices, all are tried;
// where every option is exact and serves little, up to a million.
//
// An element served by fewer than `cover` sites counts for nothing in the value. Greedy and swaps work on the sum of
// min(served, cover), which is submodular and bounds the value.
//
// Over a network of links, each step adds an option together with the relays on its cheapest way: the best by gain per
// site (or per unit of cost). Sites that have become needless are given up. Every choice on the way is connected.
//
// Turbines are placed where the fewest see them: Objective::kLeast asks for `count` options that together serve the
// least. The pairs of options that `compatible` keeps apart are the edges of a graph. Greedy adds the option that adds
// the least, among those that leave room for as many as are still missing (a set of options that fits is carried
// along). The same swaps follow. Both use only lower bounds until an option comes first, so that an option which may
// serve much is never refined.
//
// The bound from below is a Lagrangian one:
// 1. Each option has a multiplier u.
// 2. For each element that it serves an option pays weight * u / Z, where Z is the greatest sum of multipliers that
//    the options of one choice which serve the element can have.
// 3. So no choice pays more for an element than its weight, and none pays more in all than it serves.
// 4. The options that pay least, one of each group that excludes each other, therefore pay no more than the least
//    choice serves. Raising u of those that pay least tightens the bound.
// Branch and bound follows, for about a second at most. It takes the node of the least bound first, and branches at an
// option where the payments are most wrong. Where it ends in time, as it mostly does among some hundreds of options,
// the choice is proved to be the least; otherwise the bound of the best open node is what is proved.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <itin/progress.hpp>
#include <viewshed/demand.hpp>

namespace itin::viewshed {

/// A site that may be chosen. At most one of the options of one place (mast heights) is.
struct SiteOption {
  std::size_t place = 0;
  double cost = 1;
};

struct CoverageBounds {
  DemandSet certain;
  DemandSet possible;  ///< holds `certain`
  bool exact = false;  ///< whether the coverage is known: then both are the same
};

/// Bounds on what each option serves, which become tighter and tighter.
class Coverage {
 public:
  virtual ~Coverage() = default;
  virtual const CoverageBounds& bounds(std::size_t option) const = 0;
  /// Makes the bounds of each option tighter; after finitely many calls an option's bounds are exact. Not called for
  /// options whose bounds are exact. May refine others at the same time.
  virtual void refine(std::span<const std::size_t> options) = 0;
};

/// The links among sites. Sites are numbered: the options first, then the existing sites. A network keeps the links
/// that it has learned. Not for concurrent use.
class LinkNetwork {
 public:
  /// Says which of `others` a site has links with. A link has no direction; each pair is asked about once at most.
  using Linked = std::function<std::vector<std::size_t>(std::size_t site, std::span<const std::size_t> others)>;
  /// Builds a network. `hub` is one of the existing sites: every chosen site must reach it by way of chosen and
  /// existing sites. Without a hub the chosen sites must reach each other so.
  LinkNetwork(std::size_t options, std::size_t existing, std::optional<std::size_t> hub, Linked linked);

  std::size_t options() const { return options_; }
  std::size_t sites() const { return sites_; }
  std::optional<std::size_t> hub() const { return hub_; }
  /// Returns those of `others` that the site has links with.
  std::vector<std::size_t> linked(std::size_t site, std::span<const std::size_t> others);

 private:
  enum class Link : unsigned char { kUnknown, kNone, kThere };
  Link& between(std::size_t a, std::size_t b);

  std::size_t options_, sites_;
  std::optional<std::size_t> hub_;
  Linked ask_;
  std::vector<Link> links_;  ///< one for each pair of sites
};

enum class Objective {
  kMost,   ///< the sites serve as much as they can
  kLeast,  ///< exactly `count` sites serve as little as they can; no budget, share, network or k-coverage
};

struct ChoiceGoal {
  Objective objective = Objective::kMost;
  // At least one of these three is given; the choice ends at the first that is reached.
  std::optional<std::size_t> count{};
  std::optional<double> budget{};  ///< the most that the sites may cost together
  std::optional<Weight> wanted{};  ///< the value to reach, besides what existing sites serve
  int cover = 1;                   ///< how many sites must serve an element, 1 to 255
  std::vector<DemandSet> existing{};
  bool exact_chosen = true;  ///< false: bounds of chosen sites may stay open, and there are no swaps
  bool swaps = true;
  std::function<bool(std::size_t a, std::size_t b)> compatible{};  ///< whether both may be chosen; empty: any two may
  std::shared_ptr<LinkNetwork> network{};  ///< must connect the choice; null: no connection is needed
  std::size_t batch = 2;                   ///< options refined together, at most; changes the speed, never the answer
};

struct ChosenSite {
  std::size_t option = 0;
  Weight gain = 0;  ///< how much the site adds to the value, in this order
  Weight cumulative = 0;
};

/// Why an option was not taken at a step, for which bounds of it sufficed.
struct Margin {
  enum class Outcome {
    kOutbid,   ///< another was better
    kTooNear,  ///< it was better than the one taken, but not compatible with one that was chosen before
    kNoRoom,   ///< it was better than the one taken, but would have left too few others to choose from
    kTaken     ///< it was taken itself; then replaced if it is not among the chosen
  };
  double upper = 0;   ///< the best gain within its bounds (the least for kLeast), per unit of cost under a budget
  double chosen = 0;  ///< the gain of the option taken instead
  std::size_t step = 0;
  Outcome outcome = Outcome::kOutbid;
};

/// Returns 1 where the option could have been taken as well, and less the farther it was from that.
double closeness(const Margin& margin, Objective objective);

struct Choice {
  std::vector<ChosenSite> chosen;  ///< in greedy order
  Weight value = 0;                ///< served by the choice and not by existing sites alone; a lower bound if not exact
  // The value of the best choice of as many sites, or of the budget, lies between these, one of which is `value`.
  Weight lower_bound = 0;
  Weight upper_bound = 0;
  Weight existing = 0;  ///< served by existing sites alone
  double cost = 0;      ///< what the chosen sites cost together
  /// No choice that reaches ChoiceGoal::wanted costs less; nothing where that is not given or was not reached.
  std::optional<double> least_cost;
  std::size_t swaps = 0;
  std::vector<std::optional<Margin>> closest;  ///< per option: the step at which it came nearest to being taken
};

/// Checks a goal. Throws InputError for a goal that never ends, or that its objective does not take. Throws Error where
/// no choice within the goal reaches the network's hub, or where no `count` options for kLeast may be chosen together.
void check_goal(const std::vector<SiteOption>& options, const ChoiceGoal& goal);

/// Chooses among the options. Throws what check_goal() throws, Cancelled, and whatever refine() and the network throw.
Choice choose(const Demand& demand, const std::vector<SiteOption>& options, Coverage& coverage, const ChoiceGoal& goal,
              Progress& progress);

/// Returns the elements that at least `cover` of the sets hold.
DemandSet served_elements(const Demand& demand, const std::vector<DemandSet>& sets, int cover);
/// Returns the weight of served_elements().
Weight served_by(const Demand& demand, const std::vector<DemandSet>& sets, int cover);

/// Returns 100 (upper_bound - lower_bound) / upper_bound; 0 where there is nothing to gain.
double gap_percent(const Choice& choice);

}  // namespace itin::viewshed
