// What is seen along routes.
#pragma once

#include <itin/progress.hpp>
#include <viewshed/zone_study.hpp>

#include "workflows/zone/viewpoint_study.hpp"

namespace itin::viewshed {

/// Looks from places along each route of the request. Throws InputError for a route that lies off the data, or with too
/// many places; CorruptStore, Cancelled.
std::vector<StudiedRoute> study_routes(const StudySurfaces& surfaces, const ZoneStudyRequest& request, const Zone& zone,
                                       Progress& progress);

}  // namespace itin::viewshed
