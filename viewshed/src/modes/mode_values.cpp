#include "modes/mode_values.hpp"

#include <limits>

#include "request/request.hpp"

namespace itin::viewshed {

ModeValues values_outside(const Request& request, std::size_t cells) {
  const auto none = [&] { return std::vector<float>(cells, std::numeric_limits<float>::quiet_NaN()); };
  switch (request.mode) {
    case Mode::kVisible:
    case Mode::kFresnel:
      return {};
    case Mode::kCount:
      return Counts{std::vector(cells, kCountOutside)};
    case Mode::kWhich:
      return ObserverSets{std::vector<std::uint32_t>(cells * bit_grids(request.observers.size()))};
    case Mode::kAngle:
      return Angles{none()};
    case Mode::kNearest:
      return NearestObservers{std::vector<std::uint32_t>(cells), none()};
    case Mode::kBlocker:
      return Blockers{{}, std::vector(cells, kNoBlocker), {}, {}};
    case Mode::kHeight:
      return LeastHeights{none()};
    case Mode::kProbability:
      return Probabilities{none()};
    case Mode::kLoss:
      return Losses{none(), none()};
    case Mode::kLevel:
      return Levels{none(), tells_outage(request) ? none() : std::vector<float>(), std::vector<std::uint32_t>(cells)};
  }
  return {};
}

}  // namespace itin::viewshed
