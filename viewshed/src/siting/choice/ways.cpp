#include "siting/choice/ways.hpp"

#include <set>
#include <utility>

#include <itin/precondition.hpp>

namespace itin::viewshed {

namespace {

/// Visits sites along links, the nearest to the source first (Dijkstra 1959). What a site adds to the length of a way
/// depends on that site alone, so the first one that reaches it does so on the shortest way, and links between sites
/// already reached are never asked about.
template <class MayFollow, class Follow, class Length>
void follow_links(LinkNetwork& network, std::size_t source, std::vector<std::size_t> unreached,
                  const MayFollow& may_follow, const Follow& follow, const Length& length) {
  std::set<std::pair<double, std::size_t>> frontier{{0.0, source}};
  while (!frontier.empty() && !unreached.empty()) {
    const std::size_t site = frontier.begin()->second;
    frontier.erase(frontier.begin());
    std::vector<std::size_t> next;
    std::copy_if(unreached.begin(), unreached.end(), std::back_inserter(next),
                 [&](std::size_t other) { return may_follow(site, other); });
    next = network.linked(site, next);
    for (const std::size_t other : next) {
      follow(site, other);
      frontier.emplace(length(other), other);
    }
    // Both lists are in the same order.
    auto reached = next.begin();
    std::erase_if(unreached, [&](std::size_t other) {
      if (reached == next.end() || *reached != other) return false;
      ++reached;
      return true;
    });
  }
}

std::vector<std::size_t> existing_sites(const LinkNetwork& network) {
  std::vector<std::size_t> sites;
  for (std::size_t site = network.options(); site < network.sites(); ++site) sites.push_back(site);
  return sites;
}

/// Tells whether the source reaches all of the options, by way of these and of existing sites.
bool all_reached(LinkNetwork& network, std::size_t source, std::span<const std::size_t> options) {
  std::vector<std::size_t> sites = existing_sites(network);
  sites.insert(sites.end(), options.begin(), options.end());
  std::erase(sites, source);
  std::size_t missing = options.size() - static_cast<std::size_t>(std::count(options.begin(), options.end(), source));
  follow_links(
      network, source, std::move(sites), [](std::size_t, std::size_t) { return true; },
      [&](std::size_t, std::size_t site) { missing -= site < network.options(); }, [](std::size_t) { return 0.0; });
  return missing == 0;
}

class WaySearch {
 public:
  WaySearch(const ChoiceRules& rules, std::span<const std::size_t> chosen, const WayRules& way)
      : rules_(rules), chosen_(chosen), way_(way), spent_(rules.cost_of(chosen)), ways_(rules.options.size()) {
    for (std::size_t option = 0; option < rules.options.size(); ++option)
      if (!rules.is_barred(option) && !rules.place_taken(option, chosen)) candidates_.push_back(option);
  }

  Ways run() && {
    LinkNetwork* const network = rules_.goal.network.get();
    if (network != nullptr && (network->hub() || !chosen_.empty())) {
      follow_network(*network);
    } else {
      for (const std::size_t option : candidates_)
        if (fits(std::nullopt, {}, option)) ways_[option] = extended(std::nullopt, {}, option);
    }
    ways_.resize(rules_.options.size());
    return Ways(std::move(ways_));
  }

 private:
  void follow_network(LinkNetwork& network) {
    const std::size_t source = network.hub() ? *network.hub() : chosen_.front();
    ways_.resize(network.sites());
    is_free_.assign(network.sites(), false);
    std::vector<std::size_t> unreached = existing_sites(network);
    unreached.insert(unreached.end(), chosen_.begin(), chosen_.end());
    for (const std::size_t site : unreached) is_free_[site] = true;
    if (!way_.relaxed) std::erase_if(candidates_, [&](std::size_t o) { return !rules_.may_join(o, chosen_); });
    unreached.insert(unreached.end(), candidates_.begin(), candidates_.end());
    std::erase(unreached, source);
    ways_[source] = Way{};
    follow_links(
        network, source, std::move(unreached),
        [&](std::size_t site, std::size_t other) {
          return is_free_[other] || fits(last_option(site), *ways_[site], other);
        },
        [&](std::size_t site, std::size_t other) {
          ways_[other] = is_free_[other] ? Way{last_option(site), ways_[site]->sites, ways_[site]->cost}
                                         : extended(last_option(site), *ways_[site], other);
        },
        [&](std::size_t site) { return way_.by_cost ? ways_[site]->cost : static_cast<double>(ways_[site]->sites); });
    for (const std::size_t option : chosen_) ways_[option].reset();
  }

  /// The last option on the way to a site, which is the site itself if it is to be added.
  std::optional<std::size_t> last_option(std::size_t site) const {
    return is_free_[site] ? ways_[site]->before : std::optional(site);
  }
  /// Tells whether the way that ends with `last` may go on to the option.
  bool fits(std::optional<std::size_t> last, const Way& way, std::size_t option) const {
    const bool few = chosen_.size() + way.sites < way_.most_sites;
    const bool cheap = rules_.affordable(spent_ + (way.cost + rules_.options[option].cost));
    if (way_.relaxed) return way_.by_cost ? cheap : few;
    if (!few || !cheap) return false;
    for (; last; last = ways_[*last]->before)
      if (rules_.place_taken(option, {&*last, 1}) || !rules_.may_join(option, {&*last, 1})) return false;
    return true;
  }
  Way extended(std::optional<std::size_t> last, const Way& way, std::size_t option) const {
    return {last, way.sites + 1, way.cost + rules_.options[option].cost};
  }

  const ChoiceRules& rules_;
  std::span<const std::size_t> chosen_;
  WayRules way_;
  double spent_;
  std::vector<std::size_t> candidates_;
  std::vector<std::optional<Way>> ways_;
  std::vector<bool> is_free_;  ///< sites that stand or are chosen
};

}  // namespace

bool ChoiceRules::holds_together(std::span<const std::size_t> chosen) const {
  for (std::size_t i = 0; i < chosen.size(); ++i)
    if (!may_join(chosen[i], chosen.first(i))) return false;
  if (!goal.network || chosen.empty()) return true;
  return all_reached(*goal.network, goal.network->hub().value_or(chosen.front()), chosen);
}

std::vector<std::size_t> Ways::to(std::size_t option) const {
  ITIN_PRECONDITION(ways_.at(option).has_value());
  std::vector<std::size_t> result{option};
  while (const std::optional<std::size_t> before = ways_[result.back()]->before) result.push_back(*before);
  std::reverse(result.begin(), result.end());
  return result;
}

Ways ways_to_options(const ChoiceRules& rules, std::span<const std::size_t> chosen, const WayRules& way) {
  return WaySearch(rules, chosen, way).run();
}

Extensions extensions(const ChoiceRules& rules, std::span<const std::size_t> chosen, std::size_t count) {
  const std::size_t options = rules.options.size();
  Ways ways = ways_to_options(rules, chosen, {.most_sites = count, .relaxed = true});
  Extensions result{std::vector<bool>(options), std::vector<std::size_t>(options)};
  for (std::size_t option = 0; option < options; ++option) result.open[option] = ways[option].has_value();
  if (rules.goal.budget) {
    // A way that fits into the budget begins with an option that does.
    ways = ways_to_options(rules, chosen, {.most_sites = count, .by_cost = true, .relaxed = true});
    for (std::size_t option = 0; option < options; ++option)
      result.open[option] = result.open[option] && ways[option].has_value();
  }
  for (std::size_t option = 0; option < options; ++option) {
    if (!result.open[option]) continue;
    std::size_t& first = result.first[option] = option;
    while (ways[first]->before) first = *ways[first]->before;
  }
  return result;
}

std::vector<std::vector<bool>> separate_parts(const ChoiceRules& rules) {
  const std::size_t options = rules.options.size();
  LinkNetwork* const network = rules.goal.network.get();
  if (network == nullptr || network->hub()) return {std::vector<bool>(options, true)};
  std::vector<std::vector<bool>> parts;
  std::vector<std::size_t> rest(network->sites());
  for (std::size_t site = 0; site < rest.size(); ++site) rest[site] = site;
  while (!rest.empty() && rest.front() < options) {
    std::vector<bool> part(network->sites());
    part[rest.front()] = true;
    follow_links(
        *network, rest.front(), {rest.begin() + 1, rest.end()}, [](std::size_t, std::size_t) { return true; },
        [&](std::size_t, std::size_t site) { part[site] = true; }, [](std::size_t) { return 0.0; });
    std::erase_if(rest, [&](std::size_t site) { return part[site]; });
    part.resize(options);
    parts.push_back(std::move(part));
  }
  return parts;
}

}  // namespace itin::viewshed
