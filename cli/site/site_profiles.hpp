// Profiles of the links between chosen sites.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <itin/progress.hpp>
#include <itin/store.hpp>
#include <viewshed/site_plan.hpp>

namespace itin::cli {

/// A drawing of one link that is not hidden.
struct SiteProfile {
  std::string path;  ///< an SVG file
  std::string what;  ///< "a to b, 12.3 km"
  std::string svg;   ///< the sight line alone, for the report; empty where the report leaves it to the file
};

/// Draws the links that are not hidden, as `itin los --report` does, into a folder. Returns
/// them in the order of the result's links. The report shows those on routes to the hub; without a hub, the shortest
/// kMostProfiles. Throws FileError, Cancelled.
inline constexpr std::size_t kMostProfiles = 40;
std::vector<SiteProfile> write_site_profiles(const Store& store, const viewshed::SitePlan& r, const std::string& folder,
                                             bool overwrite, Progress& progress);

}  // namespace itin::cli
