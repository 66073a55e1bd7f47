#include "modes/level_observation.hpp"

#include <cmath>
#include <limits>
#include <tuple>

#include "line/infinity.hpp"
#include "request/request.hpp"

namespace itin::viewshed {

LevelObservation::LevelObservation(const Request& request) : PathObservation(request.nodata), request_(request) {
  level_.fill(-kFloatInfinity);
  outage_.fill(kFloatInfinity);
  observer_.fill(0);
}

std::uint64_t LevelObservation::observe(const TileView& tile) {
  budget_ = budget_of(request_, request_.observers[tile.observer]);
  number_ = tile.observer + 1;
  return PathObservation::observe(tile);
}

void LevelObservation::take(std::size_t cell, const LineLosses::Loss& loss) {
  profile::PathLosses losses;
  losses.ld_db = loss.diffraction_db, losses.free_space_db = loss.free_space_db;
  const profile::BudgetCourse course{
      loss.ends.length_m, {loss.ends.from_m, loss.ends.to_m}, loss.azimuth_deg, std::nullopt};
  const profile::LinkBudget budget = profile::link_budget(losses, request_.radio, course, budget_);
  const auto level = static_cast<float>(budget.level_dbm);
  const float outage = budget.availability ? static_cast<float>(budget.availability->outage_minutes) : kFloatInfinity;
  // If observers give equal levels, the one with the lesser outage counts, in whatever order they look.
  if (std::tuple(-level, outage, number_) < std::tuple(-level_[cell], outage_[cell], observer_[cell]))
    level_[cell] = level, outage_[cell] = outage, observer_[cell] = number_;
}

void LevelObservation::store_row(const StoredRow& row, Result& result) const {
  constexpr float kNoValue = std::numeric_limits<float>::quiet_NaN();
  auto& levels = result.get<Levels>();
  row.for_each([&](std::size_t cell, std::size_t place) {
    const bool known = !unknown(cell) && !std::isinf(level_[cell]);
    levels.level_dbm[place] = known ? level_[cell] : kNoValue;
    levels.observer[place] = known ? observer_[cell] : 0;
    if (!levels.outage_minutes.empty())
      levels.outage_minutes[place] = known && !std::isinf(outage_[cell]) ? outage_[cell] : kNoValue;
  });
}

}  // namespace itin::viewshed
