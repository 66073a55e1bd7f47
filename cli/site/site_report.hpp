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
  std::vector<std::string> figures;  ///< as site_figures() gives them
  std::vector<SiteProfile> profiles;
  Document parameters;               ///< shown as they are
  std::vector<std::string> sources;  ///< where the ground comes from, kind by kind
};

/// Writes the page. Throws FileError.
void write_site_report(const SiteResult& result, const SiteReportParts& parts, bool overwrite);

}  // namespace itin::cli
