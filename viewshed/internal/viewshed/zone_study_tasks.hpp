// A study of wind farms whose zone of visibility others survey.
//
//   const auto tasks = tasks_of_study(store, request, most_cells, progress);
//   ...                                                          // answered anywhere, and added
//   const ZoneStudy study = study_zone_by([&](const ZoneRequest&) { return tasks->take(); }, store, request, progress);
#pragma once

#include <cstdint>
#include <functional>
#include <memory>

#include <viewshed/tasks.hpp>
#include <viewshed/zone_study.hpp>

namespace itin::viewshed {

/// Divides the survey of the study's zone. Throws as study_zone() does.
std::unique_ptr<ZoneTasks> tasks_of_study(const Store& store, ZoneStudyRequest request, std::uint64_t most_cells,
                                          Progress& progress);

using SurveyZone = std::function<Zone(const ZoneRequest&)>;
/// Makes the study of study_zone(), whose zone comes from `survey`.
ZoneStudy study_zone_by(const SurveyZone& survey, const Store& store, ZoneStudyRequest request, Progress& progress);

}  // namespace itin::viewshed
