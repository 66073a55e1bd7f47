#include "modes/loss_observation.hpp"

#include <cmath>
#include <limits>
#include <utility>

#include "line/infinity.hpp"

namespace itin::viewshed {

namespace {

constexpr float kNoLoss = kFloatInfinity;

}  // namespace

LossObservation::LossObservation(NoData nodata) : PathObservation(nodata) {
  diffraction_.fill(kNoLoss);
  free_space_.fill(kNoLoss);
}

void LossObservation::take(std::size_t cell, const LineLosses::Loss& loss) {
  const auto diffraction = static_cast<float>(loss.diffraction_db);
  const auto free_space = static_cast<float>(loss.free_space_db);
  // If observers have equal sums, the one with the clearer line counts, whichever comes first.
  float& least = diffraction_[cell];
  float& beside = free_space_[cell];
  if (std::pair(diffraction + free_space, diffraction) < std::pair(least + beside, least))
    least = diffraction, beside = free_space;
}

void LossObservation::store_row(const StoredRow& row, Result& result) const {
  constexpr float kNoValue = std::numeric_limits<float>::quiet_NaN();
  auto& losses = result.get<Losses>();
  row.for_each([&](std::size_t cell, std::size_t place) {
    const bool known = !unknown(cell) && !std::isinf(diffraction_[cell]);
    losses.diffraction_db[place] = known ? diffraction_[cell] : kNoValue;
    losses.free_space_db[place] = known ? free_space_[cell] : kNoValue;
  });
}

}  // namespace itin::viewshed
