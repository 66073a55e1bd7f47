#include "turbines/proposal.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "turbines/zone_cells.hpp"

namespace itin::viewshed {

namespace {

bool is_proposed(const Turbine& turbine) {
  return turbine.status == TurbineStatus::kProposed;
}

/// The words of Visibility::turbines in which the proposed turbines have their bits.
std::vector<std::uint32_t> bits_of_proposal(const Zone& zone) {
  std::vector<std::uint32_t> words(zone.words);
  for (const Turbine& t : zone.request.turbines)
    if (is_proposed(t)) words[turbine_bit(t.number).grid] |= turbine_bit(t.number).mask;
  return words;
}

}  // namespace

bool has_proposal(const std::vector<Turbine>& turbines) {
  const std::size_t proposed = proposed_turbines(turbines);
  return proposed > 0 && proposed < turbines.size();
}

std::size_t turbines_with(TurbineStatus status, const std::vector<Turbine>& turbines) {
  return static_cast<std::size_t>(
      std::count_if(turbines.begin(), turbines.end(), [&](const Turbine& t) { return t.status == status; }));
}

std::vector<Turbine> turbines_of_study_area(const ZoneRequest& request) {
  std::vector<Turbine> turbines = request.turbines;
  if (has_proposal(request)) std::erase_if(turbines, [](const Turbine& t) { return !is_proposed(t); });
  return turbines;
}

std::vector<std::uint16_t> proposed_tips(const Zone& zone, const Visibility& visibility) {
  const std::vector<std::uint32_t> own = bits_of_proposal(zone);
  std::vector<std::uint16_t> tips(zone.grid.cell_count(), kCountOutside);
  for_each_cell_with_value(zone, visibility, [&](const Visibility& seen, std::size_t cell, std::size_t of_zone) {
    tips[of_zone] = 0;
    for (std::size_t w = 0; w < zone.words; ++w)
      tips[of_zone] +=
          static_cast<std::uint16_t>(std::popcount(seen.turbines[w * seen.tip_count.size() + cell] & own[w]));
  });
  return tips;
}

std::vector<std::uint8_t> additions(const Zone& zone, const Visibility& visibility) {
  const std::vector<std::uint16_t> own = proposed_tips(zone, visibility);
  std::vector<std::uint8_t> classes(own.size(), kNoAddition);
  for (std::size_t cell = 0; cell < classes.size(); ++cell) {
    if (own[cell] == kCountOutside) continue;
    const bool others = visibility.tip_count[cell] > own[cell];
    const Addition seen = own[cell] > 0 ? (others ? Addition::kBoth : Addition::kProposalAlone)
                                        : (others ? Addition::kOthersAlone : Addition::kNone);
    classes[cell] = static_cast<std::uint8_t>(seen);
  }
  return classes;
}

}  // namespace itin::viewshed
