// A siting run on one self-contained page.
#pragma once

#include <string>
#include <vector>

#include <itin/store.hpp>

#include "program/verb.hpp"
#include "site/site_profiles.hpp"
#include "site/site_result.hpp"

namespace itin::cli {

/// About how many bytes the rasters of a choice on these cells and the maps of them take.
std::uint64_t bytes_of_site_maps(const Store& store, const RasterGrid& grid);

/// Maps of what the choice serves and of how many sites serve a place, as PNG files; `warnings` gets those of drawing
/// them. Throws FileError.
void write_site_maps(const Store& store, const SiteResult& result, const std::string& directory, bool overwrite,
                     Progress& progress, std::vector<std::string>& warnings);

/// These maps as figures of the report, with buildings, links and what the sites are. Throws FileError.
std::vector<std::string> site_figures(const Store& store, const SiteResult& result, Progress& progress);

/// These maps on paper, sheet-NAME-A3.pdf and .png, where sheets are asked for; `sources` as below. Throws FileError,
/// InputError (a scale that is too large).
void write_site_sheets(const Store& store, const SiteResult& result, const std::vector<std::string>& sources,
                       const std::string& directory, bool overwrite, Progress& progress);

/// What the report shows besides the result.
struct SiteReportParts {
  std::vector<std::string> figures;  ///< of site_figures()
  std::vector<SiteProfile> profiles;
  Document parameters;               ///< shown as they are
  std::vector<std::string> sources;  ///< of the ground, sort by sort
};

/// Throws FileError.
void write_site_report(const SiteResult& result, const SiteReportParts& parts, const std::string& directory,
                       bool overwrite);

}  // namespace itin::cli
