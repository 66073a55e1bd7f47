// A viewshed as a map on a sheet of paper: `--sheet`.
#pragma once

#include <string>
#include <vector>

#include <itin/store.hpp>
#include <viewshed/viewshed.hpp>

#include "options/sheet_options.hpp"

namespace itin::cli {

/// `sources` are those of the surface, in words. Throws FileError, InputError (a scale that is too large), Cancelled.
void write_viewshed_sheet(const Store& store, const viewshed::Result& result, const SheetOptions& options,
                          const std::vector<std::string>& sources, bool overwrite, Progress& progress);

}  // namespace itin::cli
