// Links between sites, and the routes over them, as tables, documents and a layer.
#pragma once

#include <string>

#include <itin/document.hpp>
#include <itin/vector_export.hpp>

#include "site/site_result.hpp"

namespace itin::cli {

std::string links_csv(const SiteResult& result);
/// Returns the routes with one row per hop; a site that does not reach the hub has one row without a hop.
std::string routes_csv(const SiteResult& result);

Document links_document(const SiteResult& result);
Document routes_document(const SiteResult& result);

VectorLayer links_layer(const SiteResult& result);

}  // namespace itin::cli
