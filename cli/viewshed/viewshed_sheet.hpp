// A viewshed as a map on a sheet of paper: `--sheet`.
#pragma once

#include <string>
#include <vector>

#include <itin/store.hpp>
#include <viewshed/missing_ground.hpp>
#include <viewshed/result.hpp>

#include "options/sheet_options.hpp"

namespace itin::cli {

/// The facts on the sheet besides those of the result.
struct ViewshedSheetFacts {
  const viewshed::MissingGround& missing;
  const std::vector<std::string>& sources;  ///< the sources of the surface, in words
  std::string foliage = {};                 ///< how woods are seen through; empty: they are solid
};

/// Draws and writes the sheet. Throws FileError, InputError (a scale that is too large), Cancelled.
void write_viewshed_sheet(const Store& store, const viewshed::Result& result, const SheetOptions& options,
                          const ViewshedSheetFacts& facts, bool overwrite, Progress& progress);

}  // namespace itin::cli
