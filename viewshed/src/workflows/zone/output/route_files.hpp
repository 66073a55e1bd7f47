// The tables and charts of routes.
#pragma once

#include <string>
#include <vector>

#include <viewshed/zone_study.hpp>

namespace itin::viewshed {

/// Writes route-N-NAME.csv, .pdf and .svg of each route, bare and screened, and routes.csv with a row for each. Throws
/// FileError.
std::vector<ZoneFile> write_routes(const std::string& folder, const ZoneStudy& study);

}  // namespace itin::viewshed
