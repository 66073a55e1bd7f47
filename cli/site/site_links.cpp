#include "site/site_links.hpp"

#include <algorithm>
#include <cmath>

#include <itin/same_place.hpp>

namespace itin::cli {

namespace {

using viewshed::SiteStand;

double distance(const SiteStand& a, const SiteStand& b) {
  return std::hypot(a.position.x - b.position.x, a.position.y - b.position.y);
}

}  // namespace

bool SiteLinks::at_one_place(const SiteStand& a, const SiteStand& b) const {
  return same_place(store_.metadata().grid, a.position, b.position);
}

profile::LinkResult SiteLinks::between(const SiteStand& a, const SiteStand& b) const {
  return survey_link(store_, {{}, a.position, a.height, b.position, b.height}, rules_.query);
}

bool SiteLinks::connect(const std::vector<SiteStand>& stands, std::size_t a, std::size_t b) const {
  const auto key = std::minmax(a, b);
  const auto known = seen_.find(key);
  if (known != seen_.end()) return known->second;
  progress_.throw_if_cancelled();
  return seen_[key] = connect(stands[a], stands[b]);
}

bool SiteRules::spaced(std::size_t a, std::size_t b) const {
  return !min_spacing_ || distance(stands_[a], stands_[b]) >= *min_spacing_;
}

bool SiteRules::sees_hub(std::size_t option) const {
  if (!hub_) return false;
  const auto known = sees_hub_.find(option);
  if (known != sees_hub_.end()) return known->second;
  return sees_hub_[option] = links_.connect(stands_[option], *hub_);
}

bool SiteRules::sees_another_candidate(std::size_t option) const {
  const auto known = sees_another_.find(option);
  if (known != sees_another_.end()) return known->second;
  std::vector<std::size_t> others;
  for (std::size_t other = 0; other < options_; ++other)
    if (!links_.at_one_place(stands_[option], stands_[other]) && spaced(option, other)) others.push_back(other);
  // Near ones first: they are the likeliest.
  std::sort(others.begin(), others.end(), [&](std::size_t a, std::size_t b) {
    const double da = distance(stands_[option], stands_[a]), db = distance(stands_[option], stands_[b]);
    return da != db ? da < db : a < b;
  });
  return sees_another_[option] = std::any_of(others.begin(), others.end(),
                                             [&](std::size_t other) { return links_.connect(stands_, option, other); });
}

bool SiteRules::may_join(std::size_t option, std::span<const std::size_t> chosen) const {
  for (const std::size_t other : chosen)
    if (!spaced(option, other)) return false;
  if (!intervisible_ || sees_hub(option)) return true;
  if (chosen.empty()) return !hub_ && sees_another_candidate(option);
  return std::any_of(chosen.begin(), chosen.end(),
                     [&](std::size_t other) { return links_.connect(stands_, option, other); });
}

bool SiteRules::holds_together(std::span<const std::size_t> chosen) const {
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j)
      if (!spaced(chosen[i], chosen[j])) return false;
    if (!intervisible_ || sees_hub(chosen[i])) continue;
    bool linked = false;
    for (std::size_t j = 0; j < chosen.size() && !linked; ++j)
      linked = j != i && links_.connect(stands_, chosen[i], chosen[j]);
    if (!linked) return false;
  }
  return true;
}

}  // namespace itin::cli
