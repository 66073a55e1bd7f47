// A siting run on one self-contained page.
#pragma once

#include <string>
#include <vector>

#include "program/verb.hpp"
#include "site/site_profiles.hpp"
#include "site/site_result.hpp"

namespace itin::cli {

/// What the report shows besides the result.
struct SiteReportParts {
  std::vector<std::string> figures;  ///< of site_figures()
  std::vector<SiteProfile> profiles;
  Document parameters;               ///< shown as they are
  std::vector<std::string> sources;  ///< of the ground, sort by sort
};

/// Throws FileError.
void write_site_report(const SiteResult& result, const SiteReportParts& parts, bool overwrite);

}  // namespace itin::cli
