// Properties of every triangle of a surface that some modes need.
#pragma once

#include <optional>

#include <itin/tin.hpp>
#include <viewshed/request.hpp>

#include "judge/clear_zone.hpp"
#include "modes/lines/first_blocker.hpp"
#include "modes/lines/line_losses.hpp"
#include "modes/lines/triangle_finders.hpp"
#include "modes/lines/visibility_probability.hpp"
#include "request/request.hpp"

namespace itin::viewshed {

struct TriangleStudies {
  /// Makes the studies that the request's mode needs. `bare` is the ground under what stands on the surface; null where
  /// nothing does. All must outlive it, but the progress. Throws Cancelled.
  TriangleStudies(const Request& request, const TriangleFinders& surface, const TriangleFinders* bare,
                  const Progress& progress)
      : tin(surface.tin()) {
    if (request.mode == Mode::kBlocker) blockers.emplace(surface.pyramid(progress), request.earth);
    if (request.mode == Mode::kProbability)
      odds.emplace(surface.pyramid(progress), request.earth, request.vertical_error);
    if (request.mode == Mode::kFresnel)
      zone.emplace(surface.pyramid(progress), nullptr, request.earth, request.fresnel);
    if (studies_paths(request))
      losses.emplace(surface.pieces(progress), bare != nullptr ? bare->pieces(progress) : nullptr, request.radio);
  }

  const Tin& tin;
  std::optional<FirstBlocker> blockers;
  std::optional<VisibilityProbability> odds;
  std::optional<ClearZone> zone;
  std::optional<LineLosses> losses;
};

}  // namespace itin::viewshed
