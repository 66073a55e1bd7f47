// Sites and candidates of a siting run as tables, and as layers for a GIS.
#pragma once

#include <string>

#include "site/site_result.hpp"

namespace itin::cli {

/// Write the tables and the layers. Throw FileError.
void write_site_tables(const SiteResult& result, bool overwrite);
void write_site_layers(const SiteResult& result, const std::string& crs_wkt, bool overwrite);

}  // namespace itin::cli
