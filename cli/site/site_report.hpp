// A siting run on one self-contained page.
#pragma once

#include <string>
#include <vector>

#include <viewshed/site_plan.hpp>

#include "program/verb.hpp"
#include "site/site_profiles.hpp"

namespace itin::cli {

/// What the report shows besides the result.
struct SiteReportParts {
  std::vector<std::string> figures;  ///< as site_figures() gives them
  std::vector<SiteProfile> profiles;
  Document parameters;               ///< shown as they are
  std::vector<std::string> sources;  ///< where the ground comes from, kind by kind
};

/// Writes the page. Throws FileError.
void write_site_report(const std::string& path, const viewshed::SitePlan& r, const SiteReportParts& parts,
                       bool overwrite);

}  // namespace itin::cli
