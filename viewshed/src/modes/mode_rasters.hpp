// The rasters that a mode fills: which of a result's, and what they hold outside every field of view.
//
//   for_each_raster_of(mode, [&](auto raster, auto outside) { (result.*raster).assign(cells, outside); });
#pragma once

#include <cstdint>
#include <limits>

#include <viewshed/viewshed.hpp>

namespace itin::viewshed {

/// Calls visit(raster, outside) with a member of Result and the value of a cell outside, for each raster that has one
/// value per cell: not for `which`, nor for what is told of blockers once all are known.
template <class Visit>
void for_each_raster_of(Mode mode, const Visit& visit) {
  constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
  visit(&Result::visible, Verdict::kOutside);
  switch (mode) {
    case Mode::kVisible:
    case Mode::kFresnel:
    case Mode::kWhich:
      return;
    case Mode::kCount:
      return visit(&Result::count, kCountOutside);
    case Mode::kAngle:
      return visit(&Result::angle_deg, kNone);
    case Mode::kNearest:
      visit(&Result::nearest, std::uint32_t{0});
      return visit(&Result::distance_m, kNone);
    case Mode::kBlocker:
      return visit(&Result::blocker, kNoBlocker);
    case Mode::kHeight:
      return visit(&Result::least_height_m, kNone);
    case Mode::kProbability:
      return visit(&Result::probability, kNone);
    case Mode::kLoss:
      visit(&Result::loss_db, kNone);
      return visit(&Result::free_space_db, kNone);
  }
}

}  // namespace itin::viewshed
