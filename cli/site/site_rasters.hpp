// Rasters of a siting run: what the choice serves, how many sites serve a cell, and which is nearest.
#pragma once

#include <string>

#include "site/site_result.hpp"

namespace itin::cli {

/// Writes the rasters, with `parameters` unchanged in their metadata. Throws FileError.
void write_site_rasters(const SiteResult& result, const std::string& crs_wkt, const std::string& parameters,
                        bool overwrite);

}  // namespace itin::cli
