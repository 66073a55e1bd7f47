// The points of the demand and how they are served: a table, a layer and counts. Their dots on maps are declared in
// site_maps.hpp.
#pragma once

#include <string>

#include <itin/document.hpp>
#include <itin/vector_export.hpp>
#include <viewshed/site_plan.hpp>

namespace itin::viewshed {

std::string points_csv(const SitePlan& plan);
VectorLayer points_layer(const SitePlan& plan);

/// Returns how many points are of each class.
Document points_document(const SitePlan& plan);

}  // namespace itin::viewshed
