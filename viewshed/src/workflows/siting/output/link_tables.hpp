// Links between sites, and the routes over them, as tables, documents and a layer.
#pragma once

#include <string>

#include <itin/document.hpp>
#include <itin/vector_export.hpp>
#include <viewshed/site_plan.hpp>

namespace itin::viewshed {

std::string links_csv(const SitePlan& plan);
/// Returns the routes with one row per hop; a site that does not reach the hub has one row without a hop.
std::string routes_csv(const SitePlan& plan);

Document links_document(const SitePlan& plan);
Document routes_document(const SitePlan& plan);

VectorLayer links_layer(const SitePlan& plan);

}  // namespace itin::viewshed
