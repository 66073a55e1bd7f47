// Maps of a siting run: figures of its report, sheets of paper.
#pragma once

#include <string>
#include <vector>

#include <itin/progress.hpp>
#include <itin/store.hpp>
#include <viewshed/site_plan.hpp>

#include "site/site_options.hpp"

namespace itin::cli {

/// Returns the maps of the plan as figures of the report, with buildings, links and the kinds of sites. Throws
/// FileError.
std::vector<std::string> site_figures(const Store& store, const viewshed::SitePlan& r, Progress& progress);

/// Writes the maps for paper, sheet-NAME-A3.pdf and .png, where sheets are asked for. `sources` are those of the
/// ground, kind by kind. Throws FileError, InputError (a scale that is too large).
void write_site_sheets(const Store& store, const SiteOptions& options, const viewshed::SitePlan& r,
                       const std::vector<std::string>& sources, bool overwrite, Progress& progress);

}  // namespace itin::cli
