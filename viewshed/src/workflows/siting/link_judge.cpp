#include "workflows/siting/link_judge.hpp"

#include <utility>

namespace itin::viewshed {

LinkJudge::LinkJudge(const Store& store, LinkRules rules, const SectionSurface::Options& cache)
    : rules_(std::move(rules)), surface_(store, rules_.query.detail, rules_.query.themes, cache) {
  if (rules_.query.themes.includes_raised(store.metadata().themes))
    ground_.emplace(store, rules_.query.detail, ThemeChoice::none(), cache);
}

profile::LineFindings LinkJudge::found(const SitePosition& from, const SitePosition& to) const {
  const profile::LosQuery query = los_query(link_between(from, to), rules_.query);
  profile::Profile ground;
  if (ground_) ground = profile::from_section(ground_->between(from.position, to.position));
  const profile::Profile line = profile::from_section(surface_.between(from.position, to.position));
  return profile::judge(line, query, ground);
}

}  // namespace itin::viewshed
