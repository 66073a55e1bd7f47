// Properties of every triangle of a surface that some modes need.
#pragma once

#include <optional>

#include <itin/tin.hpp>
#include <viewshed/viewshed.hpp>

#include "modes/first_blocker.hpp"
#include "modes/visibility_probability.hpp"

namespace itin::viewshed {

struct TriangleStudies {
  /// Those that the request's mode needs; both must outlive it.
  TriangleStudies(const Request& request, const Tin& surface) : tin(surface) {
    if (request.mode == Mode::kBlocker) blockers.emplace(surface, request.earth);
    if (request.mode == Mode::kProbability) odds.emplace(surface, request.earth, request.vertical_error);
  }

  const Tin& tin;
  std::optional<FirstBlocker> blockers;
  std::optional<VisibilityProbability> odds;
};

}  // namespace itin::viewshed
