// Sites and candidates of a plan as tables, documents, and layers for a GIS.
#pragma once

#include <string>

#include <itin/document.hpp>
#include <itin/vector_export.hpp>
#include <viewshed/site_plan.hpp>

namespace itin::viewshed {

std::string sites_csv(const SitePlan& plan);
std::string candidates_csv(const SitePlan& plan);
/// Returns the turbines as `itin ztv` reads them.
std::string turbines_csv(const SitePlan& plan);

/// Returns an object for each chosen site.
Document chosen_document(const SitePlan& plan);

VectorLayer sites_layer(const SitePlan& plan);
VectorLayer candidates_layer(const SitePlan& plan);
VectorLayer turbines_layer(const SitePlan& plan);

}  // namespace itin::viewshed
