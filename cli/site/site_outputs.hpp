// Writes a siting run's folder.
#pragma once

#include <string>
#include <vector>

#include <itin/store.hpp>

#include "options/sheet_options.hpp"
#include "output/output_path.hpp"
#include "program/verb.hpp"
#include "site/site_result.hpp"

namespace itin::cli {

/// An output's path and what it is.
struct SiteOutput {
  std::string path;
  std::string what;
};

/// Returns every file that the run writes into the folder, which exists. Throws FileError where a file may not be
/// written, InputError where the call reads one of them.
std::vector<SiteOutput> site_outputs(const SiteOptions& options, OutputPolicy& policy);

/// The folder, within the folder of a run, that holds the profiles of links.
inline constexpr const char* kLinkFolder = "links";

/// Removes the files of the folder that an earlier run wrote, as its site.json lists them, and that are not among this
/// run's `outputs`.
void remove_former_outputs(const SiteOptions& options, const Document& outputs);

/// Returns `value`, `upper_bound`, `chosen` and the rest of the contract's document, without the members that the
/// program adds.
Document site_document(const SiteResult& result, const StoreMetadata& metadata);

}  // namespace itin::cli
