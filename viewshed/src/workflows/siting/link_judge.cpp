#include "workflows/siting/link_judge.hpp"

#include <utility>

namespace itin::viewshed {

LinkJudge::LinkJudge(const Store& store, LinkRules rules, const SectionSurface::Options& cache)
    : rules_(std::move(rules)), surface_(store, rules_.query.detail, rules_.query.themes, cache) {
  if (rules_.query.themes.includes_raised(store.metadata().themes))
    ground_.emplace(store, rules_.query.detail, ThemeChoice::none(), cache);
}

profile::LineFindings LinkJudge::found(const SitePosition& from, const SitePosition& to) const {
  const auto [line, ground] = profiles(from, to);
  return profile::judge(line, los_query(link_between(from, to), rules_.query), ground);
}

LinkJudge::Measured LinkJudge::measured(const SitePosition& from, const SitePosition& to) const {
  const auto [line, ground] = profiles(from, to);
  profile::Link link = link_between(from, to);
  const profile::LinkResult result = profile::judge_link(line, los_query(link, rules_.query), ground);
  Measured measured{*result.found, {}};
  if (from.sectors.empty()) measured.budget = link_budget_of(link, result, rules_.query);
  for (const SiteSector& sector : from.sectors) {
    link.budget.from_antenna = sector.antenna;
    auto budget = link_budget_of(link, result, rules_.query);
    if (!budget || (measured.budget && budget->level_dbm <= measured.budget->level_dbm)) continue;
    measured.budget = std::move(budget), measured.sector = sector.name;
  }
  return measured;
}

std::pair<profile::Profile, profile::Profile> LinkJudge::profiles(const SitePosition& from,
                                                                  const SitePosition& to) const {
  profile::Profile ground;
  if (ground_) ground = profile::from_section(ground_->between(from.position, to.position));
  return {profile::from_section(surface_.between(from.position, to.position)), std::move(ground)};
}

}  // namespace itin::viewshed
