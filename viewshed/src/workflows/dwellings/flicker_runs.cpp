#include "workflows/dwellings/flicker_runs.hpp"

#include <algorithm>

#include "turbines/sun_behind_rotor.hpp"

namespace itin::viewshed {

std::vector<FlickerRun> joined_runs(const std::vector<FlickerRun>& runs) {
  constexpr std::uint32_t kDay = SunYear::kMinutesOfDay;
  std::vector<FlickerRun> joined;
  for (const FlickerRun& run : runs) {
    const std::uint32_t end = run.first + run.minutes;
    const bool joins = !joined.empty() && run.first <= joined.back().first + joined.back().minutes &&
                       run.first / kDay == joined.back().first / kDay;
    if (joins)
      joined.back().minutes = std::max(joined.back().minutes, end - joined.back().first);
    else
      joined.push_back(run);
  }
  return joined;
}

std::vector<FlickerRun> flicker_runs(const Dwelling& dwelling, const std::optional<std::size_t>& turbine) {
  std::vector<FlickerRun> all;
  for (const DwellingFacade& facade : dwelling.facades)
    for (const TurbineFlicker& flicker : facade.flicker)
      if (!turbine || flicker.turbine == *turbine) all.insert(all.end(), flicker.runs.begin(), flicker.runs.end());
  std::sort(all.begin(), all.end(), [](const FlickerRun& a, const FlickerRun& b) { return a.first < b.first; });
  return joined_runs(all);
}

}  // namespace itin::viewshed
