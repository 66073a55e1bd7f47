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

/// Every file of the folder, which is there. Throws FileError where one may not be written, InputError where the call
/// reads one.
std::vector<SiteOutput> site_outputs(const SiteOptions& options, OutputPolicy& policy);

/// The folder in that of a run with the profiles of links.
inline constexpr const char* kLinkFolder = "links";

/// Removes what an earlier run wrote into the folder, as its site.json has it, and is not among this one's `outputs`.
void remove_former_outputs(const SiteOptions& options, const Document& outputs);

/// `value`, `upper_bound`, `chosen` and the rest of the contract's document, without what the program adds.
Document site_document(const SiteResult& result, const StoreMetadata& metadata);

}  // namespace itin::cli
