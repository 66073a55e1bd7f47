// The points of the demand and how they are served: a table, a layer, counts, and dots on maps.
#pragma once

#include <string>
#include <vector>

#include <itin/document.hpp>
#include <itin/vector_export.hpp>
#include <viewshed/result_sheet.hpp>
#include <viewshed/site_plan.hpp>

namespace itin::viewshed {

std::string points_csv(const SitePlan& plan);
VectorLayer points_layer(const SitePlan& plan);

/// Returns how many points are of each class.
Document points_document(const SitePlan& plan);

/// Returns dots in a colour for each class that has any points; none where masts do not serve points. Of points of a
/// class that would cover each other on a map of the plan the first is kept.
std::vector<MapObjects> objects_of_points(const SitePlan& plan);

}  // namespace itin::viewshed
