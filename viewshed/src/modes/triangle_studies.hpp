// Properties of every triangle of a surface that some modes need.
#pragma once

#include <optional>

#include <itin/tin.hpp>
#include <viewshed/request.hpp>

#include "judge/clear_zone.hpp"
#include "modes/first_blocker.hpp"
#include "modes/line_losses.hpp"
#include "modes/visibility_probability.hpp"

namespace itin::viewshed {

struct TriangleStudies {
  /// Makes the studies that the request's mode needs. `bare` is the ground under what stands on the surface; null where
  /// nothing does. All must outlive it, but the progress. Throws Cancelled.
  TriangleStudies(const Request& request, const Tin& surface, const Tin* bare, const Progress& progress)
      : tin(surface) {
    if (request.mode == Mode::kBlocker) blockers.emplace(surface, request.earth, progress);
    if (request.mode == Mode::kProbability) odds.emplace(surface, request.earth, request.vertical_error, progress);
    if (request.mode == Mode::kFresnel) zone.emplace(surface, nullptr, request.earth, request.fresnel, progress);
    if (request.mode == Mode::kLoss) losses.emplace(surface, bare, request.radio, progress);
  }

  const Tin& tin;
  std::optional<FirstBlocker> blockers;
  std::optional<VisibilityProbability> odds;
  std::optional<ClearZone> zone;
  std::optional<LineLosses> losses;
};

}  // namespace itin::viewshed
