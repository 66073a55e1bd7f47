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

/// About how many bytes the rasters of a choice on these cells and the maps of them take.
std::uint64_t bytes_of_site_maps(const Store& store, const RasterGrid& grid);

/// Maps of what the choice serves and of how many sites serve a place, as PNG files; `warnings` gets those of drawing
/// them. Throws FileError.
void write_site_maps(const Store& store, const SiteResult& result, bool overwrite, Progress& progress,
                     std::vector<std::string>& warnings);

/// These maps as figures of the report, with buildings, links and what the sites are. Throws FileError.
std::vector<std::string> site_figures(const Store& store, const SiteResult& result, Progress& progress);

/// These maps on paper, sheet-NAME-A3.pdf and .png, where sheets are asked for; `sources` of the ground, sort by
/// sort. Throws FileError, InputError (a scale that is too large).
void write_site_sheets(const Store& store, const SiteResult& result, const std::vector<std::string>& sources,
                       bool overwrite, Progress& progress);

}  // namespace itin::cli
