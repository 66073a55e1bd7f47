// Profiles of the links between chosen sites.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <itin/progress.hpp>
#include <itin/store.hpp>

#include "site/site_result.hpp"

namespace itin::cli {

/// A drawing of one link that is not hidden.
struct SiteProfile {
  std::string path;  ///< an SVG file
  std::string what;  ///< "a to b", 12.3 km
};

/// Draws the links that are not hidden, as `itin los --report` does, into the folder `links` of the directory. In the
/// order of the result's links. Throws FileError, Cancelled.
std::vector<SiteProfile> write_site_profiles(const Store& store, const SiteResult& result, const std::string& directory,
                                             bool overwrite, Progress& progress);

}  // namespace itin::cli
