// Profiles of the links between sites.
#pragma once

#include <string>
#include <vector>

#include <itin/progress.hpp>
#include <itin/store.hpp>

#include "site/site_result.hpp"

namespace itin::cli {

/// A drawing of one link in sight.
struct SiteProfile {
  std::string path;  ///< an SVG file
  std::string what;  ///< "a to b", 12.3 km
};

/// Draws the links in sight, as `itin los --report` does, into the folder `links` of the directory. In the order of the
/// result's links. Throws FileError, Cancelled.
std::vector<SiteProfile> write_site_profiles(const Store& store, const SiteResult& result, const std::string& directory,
                                             bool overwrite, Progress& progress);

}  // namespace itin::cli
