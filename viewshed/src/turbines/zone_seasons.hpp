// What is seen of turbines through woods, in leaf and in winter.
//
//   zone.seasons = survey_seasons(store, zone, survey, progress);
#pragma once

#include <functional>

#include <itin/progress.hpp>
#include <itin/store.hpp>
#include <viewshed/turbines.hpp>

namespace itin::viewshed {

/// Surveys a zone whose woods are solid. The request has foliage, so that the sets of hubs are told.
using SolidSurvey = std::function<Zone(const ZoneRequest&, Progress&)>;

/// Returns what is certainly seen of a zone's turbines through the foliage that its request has. What woods do not hide
/// is seen in both seasons, and what anything else hides is not; lines are walked between the two. Throws what the
/// survey throws.
Seasons survey_seasons(const Store& store, const Zone& zone, const SolidSurvey& survey, Progress& progress);

}  // namespace itin::viewshed
