// What documents say of a study, part by part.
#pragma once

#include <itin/document.hpp>
#include <viewshed/zone_study.hpp>

namespace itin::viewshed {

/// Tells whether viewpoints were asked for.
inline bool has_viewpoints(const ZoneStudyRequest& request) {
  return !request.viewpoints.viewpoints.empty() || request.viewpoints.rows > 0;
}

/// Returns `surface`: the surface that sight lines pass over.
Document study_surface(const ZoneStudy& study);

}  // namespace itin::viewshed
