// The files of a siting run's folder.
#pragma once

#include <string>
#include <vector>

#include <viewshed/site_plan.hpp>

#include "output/output_path.hpp"
#include "program/verb.hpp"
#include "site/site_options.hpp"

namespace itin::cli {

/// Returns every file that the run writes into the folder, which exists. Throws FileError where a file may not be
/// written, InputError where the call reads one of them.
std::vector<viewshed::PlanFile> site_outputs(const SiteOptions& options, OutputPolicy& policy);

/// The folder, within the folder of a run, that holds the profiles of links.
inline constexpr const char* kLinkFolder = "links";

/// Removes the files of the folder that an earlier run wrote, as its site.json lists them, and that are not among this
/// run's `outputs`.
void remove_former_outputs(const SiteOptions& options, const Document& outputs);

}  // namespace itin::cli
