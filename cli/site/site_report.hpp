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

/// The two maps of the report, as PNG files beside it; `warnings` gets those of drawing them. Throws FileError.
void write_site_maps(const Store& store, const SiteResult& result, const std::string& directory, bool overwrite,
                     Progress& progress, std::vector<std::string>& warnings);

/// These maps on paper, sheet-NAME-A3.pdf and .png, where sheets are asked for; `sources` as below. Throws FileError,
/// InputError (a scale that is too large).
void write_site_sheets(const Store& store, const SiteResult& result, const std::vector<std::string>& sources,
                       const std::string& directory, bool overwrite, Progress& progress);

/// `sources` are those of the ground, sort by sort; `parameters` and `inputs` are shown as they are; the maps and
/// profiles are read from their files. Throws FileError.
void write_site_report(const SiteResult& result, const std::vector<SiteProfile>& profiles, const Document& parameters,
                       const Document& inputs, const std::vector<std::string>& sources, const std::string& directory,
                       bool overwrite);

}  // namespace itin::cli
