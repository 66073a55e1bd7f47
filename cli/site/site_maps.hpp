// Maps of a siting run: pictures, figures of its report, sheets of paper.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <itin/progress.hpp>
#include <itin/raster.hpp>
#include <itin/store.hpp>

#include "site/site_result.hpp"

namespace itin::cli {

/// Returns about how many bytes the rasters of a choice on these cells, and the maps of them, take.
std::uint64_t bytes_of_site_maps(const Store& store, const RasterGrid& grid);

/// Writes maps of what the choice serves and of how many sites serve a place, as PNG files. Adds the warnings of
/// drawing them to `warnings`. Throws FileError.
void write_site_maps(const Store& store, const SiteResult& result, bool overwrite, Progress& progress,
                     std::vector<std::string>& warnings);

/// Returns these maps as figures of the report, with buildings, links and the kinds of sites. Throws FileError.
std::vector<std::string> site_figures(const Store& store, const SiteResult& result, Progress& progress);

/// Writes these maps for paper, sheet-NAME-A3.pdf and .png, where sheets are asked for. `sources` are those of the
/// ground, kind by kind. Throws FileError, InputError (a scale that is too large).
void write_site_sheets(const Store& store, const SiteResult& result, const std::vector<std::string>& sources,
                       bool overwrite, Progress& progress);

}  // namespace itin::cli
