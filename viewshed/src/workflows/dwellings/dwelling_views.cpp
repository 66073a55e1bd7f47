// What facades and dwellings see of all turbines together.

#include <viewshed/dwellings.hpp>

#include "workflows/zone/sight_summary.hpp"

namespace itin::viewshed {

namespace {

const std::vector<TurbineSight>& sights_over(const DwellingFacade& facade, SightSurface surface) {
  switch (surface) {
    case SightSurface::kBare:
      return facade.bare;
    case SightSurface::kScreened:
      return facade.screened;
    case SightSurface::kSummer:
      return facade.summer;
    case SightSurface::kWinter:
      break;
  }
  return facade.winter;
}

/// Visible before undecided, before hidden, before not looked at.
int rank_of(const std::optional<Verdict>& verdict) {
  if (verdict == Verdict::kVisible) return 3;
  if (verdict == Verdict::kUndecided) return 2;
  return verdict == Verdict::kHidden ? 1 : 0;
}

/// Takes over what another facade sees better.
void improve(TurbineSight& sight, const TurbineSight& other) {
  const auto hub = rank_of(other.hub) > rank_of(sight.hub) ? other.hub : sight.hub;
  const auto order = [](const TurbineSight& s) { return std::pair(rank_of(s.tip), s.vertical_deg); };
  if (order(other) > order(sight)) sight = other;
  sight.hub = hub;
}

std::optional<SightSummary> summary_of(const DwellingsSurvey& survey, const std::vector<TurbineSight>& sights) {
  std::vector<std::size_t> before;
  for (std::size_t t = 0; t < sights.size(); ++t)
    if (sights[t].tip != Verdict::kOutside) before.push_back(t);
  if (before.empty()) return std::nullopt;
  return seen_of(survey.request.turbines.turbines, sights, before);
}

}  // namespace

std::optional<SightSummary> view_of(const DwellingsSurvey& survey, const DwellingFacade& facade, SightSurface surface) {
  return summary_of(survey, sights_over(facade, surface));
}

std::optional<SightSummary> view_of(const DwellingsSurvey& survey, const Dwelling& dwelling, SightSurface surface) {
  TurbineSight unseen;
  unseen.tip = Verdict::kOutside;
  std::vector<TurbineSight> best;
  for (const DwellingFacade& facade : dwelling.facades) {
    const std::vector<TurbineSight>& sights = sights_over(facade, surface);
    best.resize(sights.size(), unseen);
    for (std::size_t t = 0; t < best.size(); ++t) improve(best[t], sights[t]);
  }
  return summary_of(survey, best);
}

}  // namespace itin::viewshed
